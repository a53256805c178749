// What the transfers smoothed is sharpened, where two liquids meet.
#pragma once

#include "pressure/domain.hpp"
#include "solid/thin_walls.hpp"

namespace weir {

/// One component's faces with liquid all around that have neighbours of another density, of which
/// `out` was sharpened as if all were alike. Such a pull between two faces goes by the mass of the
/// lesser: what one gains the other loses. Else a stream beside lighter liquid gains momentum, one
/// beside heavier liquid loses it, for ever.
template <class Real>
struct SharpenBetween {
    const Domain<Real>& domain;
    const VelocityOf<Real>* light;  ///< 1/density
    std::int32_t back;              ///< from a face to the one before it across its own cells
    Real smoothing;                 ///< share of ∇² that is taken off
    const VelocityOf<Real>* field;
    VelocityOf<Real>* out;

    void look_at(std::int32_t face, std::int32_t before) const {
        const std::int32_t up = domain.grid.shape.stride;
        const std::int32_t around[] = {face - 1, face + 1, face - up, face + up};
        const Real here = field[face];
        const Real own = light[face];
        Real low = here;
        Real high = here;
        Real sum = Real(0);
        bool unlike = false;
        for (const std::int32_t at : around) {
            const Real there = field[at];
            const Real other = light[at];
            const Real rise = there - here;
            low = minimum(low, there);
            high = maximum(high, there);
            unlike = unlike || other != own;
            sum += other > own ? rise * (own / other) : rise;
        }
        if (unlike && is_amid_liquid(face, before)) {
            out[face] = clamp<Real>(here - smoothing * sum, low, high);
        }
    }

private:
    /// As are the faces around. `before`: the face before it, or that one's image.
    bool is_amid_liquid(std::int32_t face, std::int32_t before) const {
        const LevelOf<Real>* const level = domain.fields.level;
        const ThinWalls<Real>* const thin = domain.walls.thin;
        const std::int32_t along = back == 1 ? domain.grid.shape.stride : 1;
        const auto deep = [&](std::int32_t at) {
            return level[at] > Real(0) && level[at - back] > Real(0);
        };
        return deep(face) && deep(before) && deep(face + back) && deep(face - along) &&
               deep(face + along) &&
               (thin == nullptr || ((thin->mark[face] | thin->mark[face - back]) & kTouching) == 0);
    }
};

/// Of both components. `sharp_u`, `sharp_v` hold what was made of `mass_u` and `mass_v`.
template <class Real>
void sharpen_between(const Domain<Real>& domain, Real smoothing, VelocityOf<Real>* sharp_u,
                     VelocityOf<Real>* sharp_v, Work work) {
    StaggeredGrid<Real>& grid = domain.grid;
    const GridShape& s = grid.shape;
    const Borders<Real>& borders = domain.borders;
    if (work.once(s.border())) {
        extend_densities(borders, grid);
    }
    // Not beside a face on a tank's wall: it may hold nothing, and has no density then.
    const auto inner = [](bool across, std::int32_t end) {
        return across ? Part{2, end - 1} : Part{0, end};
    };
    const auto look = [&](const SharpenBetween<Real>& of, const Part& rows) {
        const bool is_u = of.back == 1;
        const Part columns = inner(is_u && !borders.wrap_x, s.nx);
        const Part among = inner(!is_u && !borders.wrap_y, s.ny);
        for (std::int32_t j = maximum(rows.first, among.first); j < minimum(rows.end, among.end);
             ++j) {
            for (std::int32_t i = columns.first; i < columns.end; ++i) {
                const std::int32_t face = s.index(i, j);
                // The face before the one on the seam has cells beyond it: its image has not.
                const bool on_seam = (is_u ? i : j) == 0;
                of.look_at(face, face - of.back + (on_seam ? of.back * (is_u ? s.nx : s.ny) : 0));
            }
        }
    };
    work.share(work.take(s.ny, s.nx), s.nx, 1, [&](const Part& rows, std::int32_t) {
        look({domain, grid.inverse_density_u, 1, smoothing, grid.mass_u, sharp_u}, rows);
        look({domain, grid.inverse_density_v, s.stride, smoothing, grid.mass_v, sharp_v}, rows);
    });
}

}  // namespace weir
