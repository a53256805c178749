// Loops over faces with more lanes than every processor has.
#pragma once

#include "math/wide_lanes.hpp"

namespace weir {

struct BendTask;
struct EdgeShares;
struct ExtrapolateTask;
struct FacesToMirror;
struct MassMatrixTask;
struct MatrixUnits;
struct MirrorChanges;
struct MirrorFaces;
struct MirrorTask;
struct Mirrors;
template <class Real>
struct FlowRows;
enum class MassMatrixStep;

/// As the loops in `..._lanes.hpp` that have their names, with as many lanes as possible: where a
/// group does not fit in, with fewer, but for four.
struct WideFaces {
    std::int32_t (*velocity_faces)(const float* momentum, float* mass, float gained,
                                   std::int32_t face, std::int32_t end, float* velocity);
    std::int32_t (*sharpen_faces)(const float* level, std::int32_t back, std::int32_t stride,
                                  float smoothing, const float* field, std::int32_t face,
                                  std::int32_t end, float* out);
    std::int32_t (*blend_faces)(const float* now, const float* sharp, float share,
                                std::int32_t face, std::int32_t end, float* before);
    std::int32_t (*bend_faces)(const BendTask& task, std::int32_t row, std::int32_t face,
                               std::int32_t end);
    bool (*extrapolate_faces)(const ExtrapolateTask& task);
    FacesToMirror (*faces_to_mirror)(const MirrorTask& task, std::int32_t first);
    void (*find_mirrors)(const MirrorTask& task, bool on_u, const MirrorFaces& faces,
                         Mirrors& found);
    void (*mirror_faces)(const MirrorTask& task, bool on_u, const std::int32_t* face,
                         const Mirrors& mirrors, MirrorChanges& changes);
    std::int32_t (*unpack_pairs)(const float* pairs, std::int32_t k, std::int32_t end,
                                 float* first, float* second);
    std::int32_t (*pack_pairs)(const float* first, const float* second, std::int32_t k,
                               std::int32_t end, float* pairs);
    void (*share_edges)(bool on_u, std::int32_t stride, MatrixUnits units,
                        const float* position, std::int32_t count, EdgeShares& shares);
    std::int32_t (*mass_matrix_faces)(const MassMatrixTask& task, MassMatrixStep step,
                                      FlowRows<float> rows, std::int32_t face, std::int32_t end);
};
extern const WideFaces faces_by_eight;
extern const WideFaces faces_by_sixteen;

/// Those of this processor; null: it has no more than four lanes.
inline const WideFaces* wide_faces() {
    return loops_of_processor<WideFaces, faces_by_eight, faces_by_sixteen>();
}

}  // namespace weir
