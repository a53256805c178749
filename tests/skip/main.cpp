// weir_skip: lists its cases. weir_skip CASE absent|skipped|used: runs one, and prints what it was.
#include <cstdio>
#include <cstring>

#include "cases.hpp"

int main(int argc, char** argv) {
    constexpr const char* kWays[] = {"absent", "skipped", "used"};
    for (const skip::Case& which : skip::kCases) {
        for (int way = 0; way < 3; ++way) {
            if (!which.has[way]) {
                continue;
            }
            if (argc < 3) {
                std::printf("%s;%s;%s\n", which.name, kWays[way], which.skipped);
            } else if (std::strcmp(argv[1], which.name) == 0 &&
                       std::strcmp(argv[2], kWays[way]) == 0) {
                const skip::Run run = skip::run(which, static_cast<skip::Way>(way));
                std::printf("%lld %lld %zu %.9f\n", static_cast<long long>(run.particle_substeps),
                            static_cast<long long>(run.nodes), run.world_bytes, run.seconds);
                return 0;
            }
        }
    }
    return argc < 3 ? 0 : 1;
}
