// The pool in the order of the grid's rows, so that particles that follow each other read and write
// faces that are in the cache.
#pragma once

#include "base/array_view.hpp"
#include "base/work.hpp"
#include "fluid/particles.hpp"
#include "weir/features.hpp"

namespace weir {

/// Puts the particles in the order of their rows if they are mixed: if 64 that follow each other
/// span three rows more, on the average, than they have to. In place; the order is a function of
/// the places and the order before, and of nothing else. Cost: a look at a sixteenth of the places,
/// and if they are mixed three passes and a swap for each particle that is not in its row's part of
/// the pool.
/// @param rows that the particles are in.
/// @param scratch two numbers for each row. Too little: nothing is done.
template <class Real>
void keep_row_order(const Part& rows, ArrayView<std::int32_t> scratch,
                    Particles<Real>& particles, Work work = {});

template <class Real>
struct detail::RowOrder {
    void (*keep)(const Part& rows, ArrayView<std::int32_t> scratch, Particles<Real>& particles,
                 Work work);
};

}  // namespace weir
