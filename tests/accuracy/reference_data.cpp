#include "reference_data.hpp"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace accuracy {

Signal read_column(const std::string& path, const std::string& column) {
    std::ifstream file(path);
    std::string line;
    if (!std::getline(file, line)) {
        throw std::runtime_error("cannot read " + path);
    }
    int wanted = -1;
    int index = 0;
    std::istringstream header(line);
    for (std::string name; std::getline(header, name, ','); ++index) {
        wanted = name == column ? index : wanted;
    }
    if (wanted < 0) {
        throw std::runtime_error("no column " + column + " in " + path);
    }
    Signal signal;
    while (std::getline(file, line)) {
        std::istringstream row(line);
        std::string field;
        double first = 0.0;
        for (int k = 0; std::getline(row, field, ','); ++k) {
            if (k == 0) {
                first = std::stod(field);
            }
            if (k == wanted && !field.empty()) {
                signal.add(first, std::stod(field));
            }
        }
    }
    return signal;
}

Signal mean_of(const Signal& a, const Signal& b) {
    Signal result;
    for (std::size_t k = 0; k < a.t.size(); ++k) {
        result.add(a.t[k], 0.5 * (a.y[k] + b.y[k]));
    }
    return result;
}

}  // namespace accuracy
