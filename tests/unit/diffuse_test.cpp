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
struct Rubbing {
    GridShape shape{kColumns, kRows, kColumns + 2};
    std::vector<float> density, open, field, out;
    bool on_u;

    explicit Rubbing(bool of_u) : on_u(of_u) {
        std::mt19937 random(5);
        std::uniform_real_distribution<float> number(-0.3F, 1.2F);
        for (auto* of : {&density, &open, &field}) {
            for (std::int32_t k = 0; k < shape.size(); ++k) {
                of->push_back(of == &field ? number(random) : std::max(number(random), 0.0F));
            }
        }
        out = field;
    }
    FaceShare<float> share() const { return {density.data(), open.data(), back()}; }
    std::int32_t back() const { return on_u ? 1 : shape.stride; }
    void diffuse_from(std::int32_t first_i, std::int32_t first_j) {
        diffuse<float>(shape, share(), first_i, first_j, {0, kRows}, kAmount, kNearest,
                       field.data(), out.data());
    }
    /// By itself; `before`: the face before it along its own axis, or that one's image.
    float expected(std::int32_t face, std::int32_t before) const {
        const float own = share().at(face);
        const float here = field[static_cast<std::size_t>(face)];
        const auto pull = [&](std::int32_t neighbour) {
            const float other = share().at(neighbour == face - back() ? before : neighbour);
            const float difference = field[static_cast<std::size_t>(neighbour)] - here;
            return other < own ? difference * (other / own) : difference;
        };
        const float sum = (pull(face - 1) + pull(face + 1)) +
                          (pull(face - shape.stride) + pull(face + shape.stride));
        return own > 0.0F ? here + kAmount * sum : here;
    }
};

TEST(Diffuse, EachFaceIsPulledByTheLesserShare) {
    for (const bool on_u : {true, false}) {
        for (const bool seam : {true, false}) {
            Rubbing faces(on_u);
            const std::int32_t first_i = on_u && !seam ? 1 : 0;
            const std::int32_t first_j = on_u || seam ? 0 : 1;
            faces.diffuse_from(first_i, first_j);
            const std::int32_t period = faces.back() * (on_u ? kColumns : kRows);
            for (std::int32_t j = first_j; j < kRows; ++j) {
                for (std::int32_t i = first_i; i < kColumns; ++i) {
                    const std::int32_t face = faces.shape.index(i, j);
                    const bool on_seam = (on_u ? i : j) == 0;
                    const std::int32_t before = face - faces.back() + (on_seam ? period : 0);
                    EXPECT_EQ(faces.out[static_cast<std::size_t>(face)],
                              faces.expected(face, before))
                        << i << ", " << j;
                }
            }
        }
    }
}

}  // namespace
}  // namespace weir
