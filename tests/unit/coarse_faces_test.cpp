// The coarse grid's faces in lanes against the plain loop, patch by patch.
#include "pressure/coarse_faces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "fewer_lanes.hpp"

namespace weir {
namespace {

/// A tank of random cells, some patches of it full, some empty, some without walls.
struct Patchwork {
    StaggeredGrid<float> grid;
    Borders<float> borders;
    Walls<float> walls;
    PressureFields<float> fields;
    std::vector<float> memory;
    std::vector<CutOff> cut_off;
    std::mt19937 random;

    explicit Patchwork(std::uint32_t seed) : random(seed) {
        GridShape& s = grid.shape;
        s.nx = 9 + below(60);
        s.ny = 5 + below(20);
        s.stride = s.nx + 2;
        GridShape& big = fields.coarse.shape;
        big.nx = coarse_cells(s.nx);
        big.ny = coarse_cells(s.ny);
        big.stride = big.nx + 2;
        const auto fine = static_cast<std::size_t>(s.size()) + 16;
        const auto coarse = static_cast<std::size_t>(big.size()) + 16;
        memory.resize(4 * fine + 6 * coarse);
        float* next = memory.data();
        for (float** field : {&fields.level, &fields.inverse_diagonal, &walls.open_u,
                              &walls.open_v}) {
            *field = next;
            next += fine;
        }
        CoarseGrid<float>& c = fields.coarse;
        for (float** field : {&c.residual, &c.centre_x, &c.centre_y, &c.inverse_diagonal,
                              &c.weight_u, &c.weight_v}) {
            *field = next;
            next += coarse;
        }
        c.reach_u = c.weight_u;
        c.reach_v = c.weight_v;
        cut_off.resize(coarse);
        c.cut_off = cut_off.data();
        for_each_patch(s, big, {0, big.ny}, [&](const Patch& patch) { fill(patch); });
    }

    std::int32_t below(std::uint32_t n) { return static_cast<std::int32_t>(random() % n); }
    float share() { return static_cast<float>(below(1000)) / 999.0F; }

    void fill(const Patch& patch) {
        const std::int32_t liquid = below(4);
        const std::int32_t open = below(3);
        for (std::int32_t y = 0; y < patch.height; ++y) {
            for (std::int32_t x = 0; x < patch.width; ++x) {
                const std::int32_t at = grid.shape.index(patch.i + x, patch.j + y);
                const bool wet = liquid == 3 || (liquid > 0 && below(2) == 0);
                fields.level[at] = wet ? 0.001F + share() : -share();
                fields.inverse_diagonal[at] = wet ? (open == 0 ? 0.25F : -0.25F) : 0.0F;
                for (float* const field : {walls.open_u, walls.open_v}) {
                    const std::int32_t kind = open == 0 ? 2 : below(3);
                    field[at] = kind == 1 ? share() : kind == 2 ? 1.0F : 0.0F;
                }
            }
        }
    }

    /// Centres of all patches, and with solids what is cut off.
    template <bool Solids>
    void look() {
        CoarseGrid<float>& c = fields.coarse;
        std::fill(cut_off.begin(), cut_off.end(), CutOff{});
        for_each_patch(grid.shape, c.shape, {0, c.shape.ny}, [&](const Patch& patch) {
            if (find_centre<Solids>(grid.shape, fields, patch, c) && Solids) {
                cut_patch(walls, grid.shape, fields, patch, c);
            }
        });
        c.parted = any_cut_off(c);
    }

    /// What all faces add: by `add_patch`, or as pieces of so many rows of patches do.
    template <bool Solids>
    std::vector<float> sums(std::int32_t rows) {
        CoarseGrid<float>& c = fields.coarse;
        const GridShape& big = c.shape;
        const FaceWeights<Solids, false, float> weights{grid, borders, walls};
        std::fill(c.inverse_diagonal, memory.data() + memory.size(), 0.0F);
        if (rows == 0) {
            for_each_patch(grid.shape, big, {0, big.ny}, [&](const Patch& patch) {
                add_patch(weights, fields, patch, Targets{}, c);
            });
        }
        for (std::int32_t first = 0; rows > 0 && first < big.ny; first += rows) {
            const std::int32_t end = std::min(first + rows, big.ny);
            Targets targets;
#if WEIR_PARALLEL
            targets.low = big.index(-1, first == 0 ? -1 : first);
            targets.end = big.index(-1, end == big.ny ? end + 1 : end);
#endif
            const Part all{std::max(first - 1, 0), std::min(end + 1, big.ny)};
            add_patches(weights, fields, all, targets, c);
        }
        return {c.inverse_diagonal, memory.data() + memory.size()};
    }
};

TEST(CoarseFaces, HaveTheBitsOfThePlainLoop) {
    for (std::uint32_t seed = 0; seed < 400; ++seed) {
        Patchwork patches(seed);
        for (const std::int32_t lanes : {4, 0}) {
            const Fewer fewer(lanes);
            patches.look<true>();
            for (const std::int32_t rows : {WEIR_PARALLEL ? 2 : 99, 99}) {
                EXPECT_EQ(patches.sums<true>(rows), patches.sums<true>(0)) << seed;
            }
            patches.look<false>();
            for (const std::int32_t rows : {WEIR_PARALLEL ? 2 : 99, 99}) {
                EXPECT_EQ(patches.sums<false>(rows), patches.sums<false>(0)) << seed;
            }
        }
    }
}

}  // namespace
}  // namespace weir
