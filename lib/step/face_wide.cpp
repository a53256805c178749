// Loops over faces with eight lanes.
#include "step/bend_lanes.hpp"
#include "step/extrapolate_lanes.hpp"
#include "step/face_lanes.hpp"
#include "step/mirror_lanes.hpp"

#if WEIR_HAS_WIDE_LANES

namespace weir {

std::int32_t velocity_wide(const float* momentum, float* mass, float gained, std::int32_t face,
                           std::int32_t end, float* velocity) {
    return velocity_faces<EightLanes>(momentum, mass, gained, face, end, velocity);
}

std::int32_t sharpen_wide(const float* level, std::int32_t back, std::int32_t stride,
                          float smoothing, const float* field, std::int32_t face,
                          std::int32_t end, float* out) {
    return sharpen_faces<EightLanes>(level, back, stride, smoothing, field, face, end, out);
}

std::int32_t blend_wide(const float* now, const float* sharp, float share, std::int32_t face,
                        std::int32_t end, float* before) {
    return blend_faces<EightLanes>(now, sharp, share, face, end, before);
}

std::int32_t bend_wide(const BendTask& task, std::int32_t row, std::int32_t face,
                       std::int32_t end) {
    return bend_faces<EightLanes>(task, row, face, end);
}

void find_mirrors_wide(const MirrorTask& task, bool on_u, const MirrorFaces& faces,
                       std::int32_t j, Mirrors& found) {
    const auto find = on_u ? find_mirrors<EightLanes, true> : find_mirrors<EightLanes, false>;
    find(task, faces, j, found);
}

void mirror_faces_wide(const MirrorTask& task, bool on_u, const std::int32_t* face,
                       const Mirrors& mirrors, MirrorChanges& changes) {
    const auto mirror = on_u ? mirror_faces<EightLanes, true> : mirror_faces<EightLanes, false>;
    mirror(task, face, mirrors, changes);
}

bool extrapolate_wide(const ExtrapolateTask& task) {
    return extrapolate_faces<EightLanes>(task);
}

}  // namespace weir

#endif
