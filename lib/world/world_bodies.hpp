// What the files of World's body calls share.
#pragma once

#include "world/world_state.hpp"

namespace weir {

/// Makes a body free, by what holds it.
template <class Real>
using SetFree = void (*)(Hold, BodyLoad<Real>&);

template <class Real>
Status add_body(detail::WorldState<Real>& state, const BodyDef& def, BodyKind kind, BodyId* id,
                SetFree<Real> set_free = nullptr);

/// stale_body, or ok.
template <class Real>
Status check_id(const detail::WorldState<Real>& state, BodyId id);

}  // namespace weir
