// What liquid at rest does to a free body, by the cells and films that press on it.
#pragma once

#include "solid/body_force.hpp"
#include "solid/obstacles.hpp"

namespace weir {

template <class Real>
struct AtRest {
    Impulse<Real> open;  ///< what is lacking to a closed outline
    Impulse<Real> push;  ///< over the liquid's density
    bool has_film = false;

    void press(const Impulse<Real>& reach, Face<Real> pressure) {
        open.add(reach);
        push.add(Impulse<Real>{pressure * reach.linear, pressure * reach.angular});
    }
    /// Of the body's area, if that is closed and lifted; otherwise none.
    Face<Real> lifted(Vec2<Face<Real>> gravity) const {
        const Face<Real> square = dot(gravity, gravity);
        return is_closed() && square > Face<Real>(0) ? -dot(gravity, push.linear) / square
                                                     : Face<Real>(0);
    }
    bool is_closed() const {
        constexpr Face<Real> kClosed = Face<Real>(1.0 / 64.0);  // of a face
        return has_film && absolute(open.linear.x) + absolute(open.linear.y) < kClosed;
    }
};

enum class Turning { left_out, asked };

/// About the body's centre of mass, where there is no pressure. Of bodies without a film there is
/// only told that.
/// Cost: a look at each film, and at each cell of the body's rectangle; as `impulse_on_free`, if
/// what turns the body is asked for.
template <class Real>
AtRest<Real> at_rest(const Obstacles<Real>& obstacles, const PressedCells<Real>& cells,
                     std::uint16_t slot, Turning turning);

}  // namespace weir
