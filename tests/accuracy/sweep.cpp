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

std::vector<Plan> chosen(const Effort& effort, const std::vector<Plan>& plans) {
    if (effort.scheme.empty()) {
        return plans;
    }
    const Kind wanted = kind_named(effort.scheme);
    std::vector<Plan> result;
    for (const Plan& plan : plans) {
        if (plan.kind == in_float(wanted)) {
            result.push_back({wanted, plan.cells, plan.lattices});
        }
    }
    return result;
}

std::vector<Plan> beside_others(const Effort& effort, const std::vector<int>& cells,
                                const std::vector<Kind>& others) {
    std::vector<Plan> plans = {{Kind::projection, cells, 3}};
    for (const Kind kind : others) {
        plans.push_back({kind, {effort.quick ? 16 : 32}, effort.quick ? 3 : 1});
    }
    return chosen(effort, plans);
}

std::string title_of(const Plan& plan, std::size_t resolution) {
    return std::string(kind_name(plan.kind)) + " " + std::to_string(plan.cells[resolution]);
}

namespace {

using Figures = std::map<std::string, std::vector<double>>;

/// Runs all lattices. @return what came of the last.
Outcome run_lattices(Report& report, const Effort& effort, const std::string& name,
                     const Plan& plan, int cells, const Run& run,
                     const std::vector<Metric>& metrics, Figures& figures) {
    Outcome outcome;
    for (int k = 0; k < plan.lattices; ++k) {
        Case c;
        c.cells = cells;
        c.lattice = kLattices[k];
        c.options = effort.options;
        const std::unique_ptr<Scheme> scheme = make_scheme(plan.kind);
        outcome = run(*scheme, c);
        const std::string at = name + "." + lattice_name(c.lattice);
        if (!outcome.broken.empty()) {
            report.broken(at + " " + outcome.broken);
        }
        if (scheme->limited() > 0) {
            report.figure(at + ".steps_limited", double(scheme->limited()), "1");
        }
        for (const Metric& metric : metrics) {
            figures[metric.name].push_back(outcome.value(metric.name));
        }
    }
    return outcome;
}

double largest_of(const std::vector<double>& values) {
    double largest = 0.0;
    for (const double value : values) {
        largest = largest < std::fabs(value) ? std::fabs(value) : largest;
    }
    return largest;
}

}  // namespace

std::vector<Outcome> sweep(Report& report, const Effort& effort, const std::string& problem,
                           const Plan& plan, const std::vector<Metric>& metrics, const Run& run) {
    const std::string prefix = problem + "." + kind_name(plan.kind);
    std::vector<Outcome> last;
    Figures worst;
    std::vector<int> done;
    for (const int cells : plan.cells) {
        const std::string name = prefix + "." + std::to_string(cells);
        Figures figures;
        try {
            last.push_back(
                run_lattices(report, effort, name, plan, cells, run, metrics, figures));
        } catch (const Unable& why) {
            report.skipped(name, why.what());
            break;
        }
        for (const Metric& metric : metrics) {
            report.worst_of(prefix, metric, cells, figures[metric.name]);
            worst[metric.name].push_back(largest_of(figures[metric.name]));
        }
        done.push_back(cells);
    }
    if (done.size() > 1) {
        const std::vector<double> cells(done.begin(), done.end());
        std::vector<std::vector<double>> errors;
        for (const Metric& metric : metrics) {
            errors.push_back(worst[metric.name]);
            report.order(prefix, metric, convergence_order(cells, errors.back()));
        }
        report.convergence(prefix, done, metrics, errors);
    }
    return last;
}

}  // namespace accuracy
