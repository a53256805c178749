#include <cmath>
#include <map>

#include "problems.hpp"

namespace accuracy {

std::vector<int> resolutions(const Effort& effort, int most) {
    std::vector<int> result;
    for (const int cells : {16, 32, 64, 128}) {
        const bool wanted = effort.quick ? cells <= 32 : cells >= 32;
        if (wanted && cells <= most) {
            result.push_back(cells);
        }
    }
    return result;
}

std::vector<Outcome> sweep(Report& report, const Effort& effort, const std::string& problem,
                           const Plan& plan, const std::vector<Metric>& metrics, const Run& run) {
    const std::string prefix = problem + "." + kind_name(plan.kind);
    std::vector<Outcome> last;
    if (!effort.scheme.empty() && effort.scheme != kind_name(plan.kind)) {
        return last;
    }
    std::map<std::string, std::vector<double>> worst;
    for (const int cells : plan.cells) {
        std::map<std::string, std::vector<double>> figures;
        Outcome outcome;
        for (int k = 0; k < plan.lattices; ++k) {
            Case c;
            c.cells = cells;
            c.lattice = kLattices[k];
            c.options = effort.options;
            const std::unique_ptr<Scheme> scheme = make_scheme(plan.kind);
            outcome = run(*scheme, c);
            if (!outcome.broken.empty()) {
                report.broken(prefix + "." + std::to_string(cells) + "." +
                              lattice_name(c.lattice) + " " + outcome.broken);
            }
            for (const Metric& metric : metrics) {
                figures[metric.name].push_back(outcome.value(metric.name));
            }
        }
        for (const Metric& metric : metrics) {
            const std::vector<double>& values = figures[metric.name];
            report.worst_of(prefix, metric, cells, values);
            double largest = 0.0;
            for (const double value : values) {
                largest = largest < std::fabs(value) ? std::fabs(value) : largest;
            }
            worst[metric.name].push_back(largest);
        }
        last.push_back(std::move(outcome));
    }
    if (plan.cells.size() > 1) {
        const std::vector<double> cells(plan.cells.begin(), plan.cells.end());
        std::vector<std::vector<double>> errors;
        for (const Metric& metric : metrics) {
            errors.push_back(worst[metric.name]);
            report.order(prefix, metric, convergence_order(cells, errors.back()));
        }
        report.convergence(prefix, plan.cells, metrics, errors);
    }
    return last;
}

}  // namespace accuracy
