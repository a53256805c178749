// What the files of World's body calls share.
#pragma once

#include "world/world_state.hpp"

namespace weir {

template <class Real>
Status add_body(detail::WorldState<Real>& state, const BodyDef& def, BodyKind kind, BodyId* id);

/// stale_body, or ok.
template <class Real>
Status check_id(const detail::WorldState<Real>& state, BodyId id);

}  // namespace weir
