// Faces that rub on their neighbours.
#include "grid/diffuse.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace weir {
namespace {

constexpr std::int32_t kColumns = 21;  // no whole number of groups
constexpr std::int32_t kRows = 7;
constexpr float kAmount = 0.2F;

/// Liquid of any density here and there, moving anyhow.
struct Patch {
    GridShape shape{kColumns, kRows, kColumns + 2};
    std::vector<float> density, open_u, open_v, u, v, out;

    explicit Patch(float least_dense) {
        std::mt19937 random(5);
        std::uniform_real_distribution<float> number(-0.3F, 1.2F);
        for (auto* of : {&density, &open_u, &open_v, &u, &v}) {
            for (std::int32_t k = 0; k < shape.size(); ++k) {
                const float any = number(random);
                const float least = of == &density ? least_dense : 0.0F;
                of->push_back(of == &u || of == &v ? any : std::clamp(any, least, 1.0F));
            }
        }
    }
    Rubbing<float> of(bool on_u, bool seam) const {
        const std::int32_t back = on_u ? 1 : shape.stride;
        return {{density.data(), (on_u ? open_u : open_v).data(), back},
                (on_u ? u : v).data(),
                on_u && !seam ? 1 : 0,
                on_u || seam ? 0 : 1,
                !seam};
    }
    void diffuse_all(bool on_u, bool seam) {
        out = on_u ? u : v;
        diffuse<float>(shape, of(on_u, seam), of(!on_u, seam), {0, kRows}, kAmount, kNearest,
                       out.data());
    }
    /// A face after its neighbours have pulled, each by the lesser mass; the one before a face
    /// `on_seam` is the image of the last.
    float by_laplacian(const Rubbing<float>& faces, std::int32_t face, bool on_seam) const {
        const std::int32_t back = faces.share.back;
        const std::int32_t period = back == 1 ? kColumns : back * kRows;
        const float own = faces.share.at(face);
        const float here = faces.field[face];
        const auto from = [&](std::int32_t at) {
            const bool beyond = on_seam && at == face - back;
            const float mass = faces.share.at(beyond ? at + period : at);
            const float difference = faces.field[at] - here;
            return mass < own ? difference * (mass / own) : difference;
        };
        const float sum = (from(face - 1) + from(face + 1)) +
                          (from(face - shape.stride) + from(face + shape.stride));
        return own > 0.0F ? here + kAmount * sum : here;
    }
    /// What component a face pulls on the next one with, `step` entries on, over kAmount: by the
    /// stress between them, times the least mass there and the least volume's cube. `plus`,
    /// `minus`: faces of the other component.
    float pull(bool on_u, std::int32_t face, std::int32_t step, std::int32_t plus,
               std::int32_t minus) const {
        const auto own = of(on_u, false);
        const auto other = of(!on_u, false);
        const float volume = std::min({own.share.volume(face), own.share.volume(face + step),
                                       other.share.volume(plus), other.share.volume(minus)});
        const float mass = std::min({own.share.at(face), own.share.at(face + step), volume});
        return volume * volume * volume * mass *
               ((own.field[face + step] - own.field[face]) +
                (other.field[plus] - other.field[minus]));
    }
};

TEST(Diffuse, AmidLiquidFacesArePulledByTheLaplacian) {
    for (const bool on_u : {true, false}) {
        for (const bool seam : {true, false}) {
            Patch patch(1.0F);
            patch.diffuse_all(on_u, seam);
            const Rubbing<float> faces = patch.of(on_u, seam);
            for (std::int32_t j = faces.first_j; j < kRows; ++j) {
                for (std::int32_t i = faces.first_i; i < kColumns; ++i) {
                    const std::int32_t face = patch.shape.index(i, j);
                    const float expected = patch.by_laplacian(faces, face, (on_u ? i : j) == 0);
                    EXPECT_EQ(patch.out[static_cast<std::size_t>(face)], expected)
                        << i << ", " << j;
                }
            }
        }
    }
}

TEST(Diffuse, ElsewhereByTheStress) {
    for (const bool on_u : {true, false}) {
        Patch patch(0.0F);
        patch.open_u.assign(patch.open_u.size(), 1.0F);
        patch.open_v.assign(patch.open_v.size(), 1.0F);
        patch.diffuse_all(on_u, false);
        const Rubbing<float> faces = patch.of(on_u, false);
        const std::int32_t back = faces.share.back;
        const std::int32_t side = on_u ? patch.shape.stride : 1;
        for (std::int32_t j = 1; j < kRows - 1; ++j) {
            for (std::int32_t i = 1; i < kColumns - 1; ++i) {
                const std::int32_t f = patch.shape.index(i, j);
                const float own = faces.share.at(f);
                const float sum = patch.pull(on_u, f, back, f, f + side) +
                                  patch.pull(on_u, f, -back, f + side - back, f - back) +
                                  patch.pull(on_u, f, side, f + side, f + side - back) +
                                  patch.pull(on_u, f, -side, f - back, f);
                const float change = own > 0.0F ? kAmount * sum / own : 0.0F;
                EXPECT_NEAR(patch.out[static_cast<std::size_t>(f)], faces.field[f] + change, 1e-5F)
                    << i << ", " << j;
            }
        }
    }
}

/// Liquid with holes between the tank's walls, or round its seams, of one density or of any.
struct Pool {
    Patch patch{0.0F};
    std::vector<float> light_u, light_v;
    bool seam;
    float image;  ///< of what goes along a wall: 1 where that is slippery, −1 where not

    Pool(bool round, bool mixed, bool slippery, std::uint32_t seed)
        : seam(round), image(slippery ? 1.0F : -1.0F) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> number(-1.0F, 1.0F);
        const float room = number(random);
        for (auto* of : {&light_u, &light_v, &patch.density, &patch.u, &patch.v}) {
            of->assign(static_cast<std::size_t>(patch.shape.size()), 1.0F);
            for (float& any : *of) {
                const bool is_speed = of == &patch.u || of == &patch.v;
                any = number(random);
                any = of == &patch.density ? std::clamp(0.6F + room + any, 0.0F, 1.0F)
                      : is_speed           ? any
                                           : (any < 0.0F ? 10.0F : 1.0F);
            }
        }
        fill(patch.density, 1.0F, 1.0F, false, false);
        fill(light_u, 1.0F, 1.0F, true, false);
        fill(light_v, 1.0F, 1.0F, false, true);
        fill_velocities();
        if (!mixed) {
            light_u.clear();
            light_v.clear();
        }
    }
    /// Ghosts, `on_x` and `on_y` times what they are images of: of cells or, `is_u` and `is_v`, of
    /// faces, on which there is a wall.
    void fill(std::vector<float>& of, float on_x, float on_y, bool is_u, bool is_v) const {
        const GridShape& s = patch.shape;
        const auto at = [&](std::int32_t i, std::int32_t j) -> float& {
            return of[static_cast<std::size_t>(s.index(i, j))];
        };
        for (std::int32_t j = 0; j < kRows; ++j) {
            if (is_u && !seam) {
                at(0, j) *= on_x;
                at(kColumns, j) *= on_x;
            } else {
                at(-1, j) = seam ? at(kColumns - 1, j) : on_x * at(0, j);
                at(kColumns, j) = seam ? at(0, j) : on_x * at(kColumns - 1, j);
            }
        }
        for (std::int32_t i = -1; i <= kColumns; ++i) {
            if (is_v && !seam) {
                at(i, 0) *= on_y;
                at(i, kRows) *= on_y;
            } else {
                at(i, -1) = seam ? at(i, kRows - 1) : on_y * at(i, 0);
                at(i, kRows) = seam ? at(i, 0) : on_y * at(i, kRows - 1);
            }
        }
    }
    void fill_velocities() {
        fill(patch.u, seam ? 1.0F : 0.0F, image, true, false);
        fill(patch.v, image, seam ? 1.0F : 0.0F, false, true);
    }
    Rubbing<float> of(bool on_u) const {
        Rubbing<float> faces = patch.of(on_u, seam);
        faces.share.open = nullptr;
        faces.share.light = light_u.empty() ? nullptr : (on_u ? light_u : light_v).data();
        return faces;
    }
    void diffuse_both(float amount) {
        std::vector<float> next_u = patch.u;
        std::vector<float> next_v = patch.v;
        const Part rows{0, kRows};
        diffuse<float>(patch.shape, of(true), of(false), rows, amount, kNearest, next_u.data());
        diffuse<float>(patch.shape, of(false), of(true), rows, amount, kNearest, next_v.data());
        patch.u = next_u;
        patch.v = next_v;
        fill_velocities();
    }
    /// Σ m u a
    double product(const std::vector<float>& a_u, const std::vector<float>& a_v) const {
        double sum = 0.0;
        for (const bool on_u : {true, false}) {
            const Rubbing<float> faces = of(on_u);
            const float* const a = (on_u ? a_u : a_v).data();
            for (std::int32_t j = faces.first_j; j < kRows; ++j) {
                for (std::int32_t i = faces.first_i; i < kColumns; ++i) {
                    const std::int32_t f = patch.shape.index(i, j);
                    sum += static_cast<double>(faces.share.at(f)) *
                           static_cast<double>(faces.field[f]) * static_cast<double>(a[f]);
                }
            }
        }
        return sum;
    }
    double energy() const { return product(patch.u, patch.v); }
};

/// What one flow loses to another's pulls, the other loses to the one's.
TEST(Diffuse, PullsAreMutual) {
    for (std::uint32_t seed = 0; seed < 64; ++seed) {
        Pool one((seed & 1U) != 0, (seed & 2U) != 0, (seed & 4U) != 0, seed);
        Pool other = one;
        for (std::size_t k = 0; k < one.patch.u.size(); ++k) {
            other.patch.u[k] = one.patch.v[k];
            other.patch.v[k] = one.patch.u[one.patch.u.size() - 1 - k];
        }
        other.fill_velocities();
        const Patch first = one.patch;
        const Patch second = other.patch;
        const double energy = one.energy();
        one.diffuse_both(kAmount);
        other.diffuse_both(kAmount);
        EXPECT_NEAR(one.product(second.u, second.v), other.product(first.u, first.v),
                    2e-6 * energy) << seed;
    }
}

/// In the longest step that is taken, too, whatever goes on in whatever liquid: what is left after
/// many steps is that which grows most, or fades least.
TEST(Diffuse, NeverGainsEnergy) {
    constexpr float kMost = 0.25F;
    for (std::uint32_t seed = 0; seed < 160; ++seed) {
        Pool pool((seed & 1U) != 0, (seed & 2U) != 0, (seed & 4U) != 0, seed);
        for (int step = 0; step < 60; ++step) {
            const double before = pool.energy();
            pool.diffuse_both(kMost);
            EXPECT_LE(pool.energy(), before * (1.0 + 1e-5)) << seed << ", step " << step;
        }
    }
}

}  // namespace
}  // namespace weir
