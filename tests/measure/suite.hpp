// What programs that measure have in common: problems by name, each timed, one report.
#pragma once

#include <chrono>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

namespace measure {

template <class Report, class Effort>
struct Problem {
    const char* name;
    const char* title;
    void (*run)(Report&, const Effort&);
};

template <class Problems>
bool known(const Problems& problems, const std::string& name) {
    for (const auto& problem : problems) {
        if (name == problem.name) {
            return true;
        }
    }
    return false;
}

/// No names: every problem.
inline bool chosen(const std::vector<std::string>& names, const std::string& name) {
    for (const std::string& wanted : names) {
        if (wanted == name) {
            return true;
        }
    }
    return names.empty();
}

/// @return the exit status of a program that is called wrongly.
template <class Problems>
int usage(const char* arguments, const Problems& problems) {
    std::fprintf(stderr, "usage: %s [NAME ...]\nnames:", arguments);
    for (const auto& problem : problems) {
        std::fprintf(stderr, " %s", problem.name);
    }
    std::fprintf(stderr, "\n");
    return 2;
}

/// @return the exit status: 1 if a target is short, 2 if `path` cannot be written.
template <class Report, class Problems, class Effort>
int run(const char* path, const Problems& problems, const std::vector<std::string>& names,
        const Effort& effort) {
    try {
        Report report(path);
        for (const auto& problem : problems) {
            if (!chosen(names, problem.name)) {
                continue;
            }
            report.heading(std::string(problem.name) + ": " + problem.title);
            const auto begin = std::chrono::steady_clock::now();
            try {
                problem.run(report, effort);
            } catch (const std::exception& error) {
                std::printf("  %s\n", error.what());
                report.holds(std::string(problem.name) + ".ran_to_its_end", false);
            }
            const auto end = std::chrono::steady_clock::now();
            std::printf("  (%.1f s)\n", std::chrono::duration<double>(end - begin).count());
        }
        report.summary();
        return report.is_short() ? 1 : 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
}

}  // namespace measure
