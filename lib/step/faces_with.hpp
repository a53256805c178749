// The loops over faces with so many lanes, for a file compiled for processors that have them.
#pragma once

#include "math/eight_lanes.hpp"
#include "step/bend_lanes.hpp"
#include "step/extrapolate_lanes.hpp"
#include "step/face_lanes.hpp"
#include "step/mass_matrix_lanes.hpp"
#include "step/mirror_lanes.hpp"
#include "step/transfer_kernels.hpp"
#include "step/wide_faces.hpp"

namespace weir {

#if WEIR_HAS_WIDE_LANES

/// With L, and what is left with eight.
template <class L>
struct FacesWith {
    static std::int32_t velocity(const float* momentum, float* mass, float gained,
                                 std::int32_t face, std::int32_t end, float* velocity) {
        face = velocity_faces<L>(momentum, mass, gained, face, end, velocity);
        return velocity_faces<EightLanes>(momentum, mass, gained, face, end, velocity);
    }
    static std::int32_t sharpen(const float* level, std::int32_t back, std::int32_t stride,
                                float smoothing, const float* field, std::int32_t face,
                                std::int32_t end, float* out) {
        face = sharpen_faces<L>(level, back, stride, smoothing, field, face, end, out);
        return sharpen_faces<EightLanes>(level, back, stride, smoothing, field, face, end, out);
    }
    static std::int32_t blend(const float* now, const float* sharp, float share,
                              std::int32_t face, std::int32_t end, float* before) {
        face = blend_faces<L>(now, sharp, share, face, end, before);
        return blend_faces<EightLanes>(now, sharp, share, face, end, before);
    }
    static std::int32_t bend(const BendTask& task, std::int32_t row, std::int32_t face,
                             std::int32_t end) {
        face = bend_faces<L>(task, row, face, end);
        return bend_faces<EightLanes>(task, row, face, end);
    }
    static bool extrapolate(const ExtrapolateTask& task) {
        return extrapolate_faces<L>(task) || extrapolate_faces<EightLanes>(task);
    }
    static void find(const MirrorTask& task, bool on_u, const MirrorFaces& faces,
                     Mirrors& found) {
        const auto look = on_u ? find_mirrors<EightLanes, true> : find_mirrors<EightLanes, false>;
        look(task, faces, found);
    }
    static void mirror(const MirrorTask& task, bool on_u, const std::int32_t* face,
                       const Mirrors& mirrors, MirrorChanges& changes) {
        const auto take = on_u ? mirror_faces<EightLanes, true> : mirror_faces<EightLanes, false>;
        take(task, face, mirrors, changes);
    }
    static std::int32_t unpack(const float* pairs, std::int32_t k, std::int32_t end, float* first,
                               float* second) {
        k = unpack_pairs<L>(pairs, k, end, first, second);
        return unpack_pairs<EightLanes>(pairs, k, end, first, second);
    }
    static std::int32_t pack(const float* first, const float* second, std::int32_t k,
                             std::int32_t end, float* pairs) {
        k = pack_pairs<L>(first, second, k, end, pairs);
        return pack_pairs<EightLanes>(first, second, k, end, pairs);
    }

    static constexpr WideFaces kLoops{velocity, sharpen, blend,  bend, extrapolate,
                                      faces_to_mirror<EightLanes>,
                                      find,     mirror,  unpack, pack,
                                      share_edges<EightLanes>, mass_matrix_faces<EightLanes>};
};

#endif

}  // namespace weir
