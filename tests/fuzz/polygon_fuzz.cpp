// libFuzzer target: random bytes as a polygon with holes, checked, cut into pieces, added to a
// world, rasterized and met by liquid. Besides what the sanitizers find, it stops if a refused body
// changed the world, if a fault names no vertex, if pieces are not convex or do not have the
// polygon's area, or if a particle is lost.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "geometry/bridges.hpp"
#include "geometry/convex_decomposition.hpp"
#include "geometry/ring_copy.hpp"
#include "weir/weir.hpp"

extern "C" void weir_fault(const char*, const char*, int) { std::abort(); }

namespace {

using weir::Status;
using weir::Vec2f;
using weir::View;

/// Reads the input; zeros when it is used up.
class Bytes {
public:
    Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
    bool empty() const { return at_ >= size_; }
    std::uint8_t byte() { return empty() ? std::uint8_t{0} : data_[at_++]; }
    float number() {
        std::uint8_t raw[4];
        for (std::uint8_t& part : raw) {
            part = byte();
        }
        float value = 0.0F;
        std::memcpy(&value, raw, sizeof value);
        return value;
    }
    float eighth() { return static_cast<float>(static_cast<std::int8_t>(byte())) * 0.125F; }

private:
    const std::uint8_t* data_;
    std::size_t size_;
    std::size_t at_ = 0;
};

/// The first byte says what is tried.
struct Options {
    bool any_float;  // else coordinates are on a lattice, where all is exact
    bool moving;
    bool binary;
    bool world;
    bool in_double;
};

Options options_of(std::uint8_t flags) {
    return {(flags & 3U) == 3U, (flags & 4U) != 0, (flags & 8U) != 0, (flags & 0x70U) == 0x70U,
            (flags & 0x80U) != 0};
}

struct Input {
    std::vector<std::vector<Vec2f>> rings;
    std::vector<View<Vec2f>> views;

    View<Vec2f> outer() const { return views[0]; }
    View<View<Vec2f>> holes() const {
        return {views.data() + 1, static_cast<std::int32_t>(views.size()) - 1};
    }
};

Input read_rings(Bytes& bytes, bool any_float) {
    Input input;
    do {
        std::vector<Vec2f> ring(bytes.byte() % 32U);
        for (Vec2f& vertex : ring) {
            if (any_float) {
                vertex.x = bytes.number();
                vertex.y = bytes.number();
            } else {
                vertex.x = bytes.eighth();
                vertex.y = bytes.eighth();
            }
        }
        input.rings.push_back(ring);
    } while (!bytes.empty() && input.rings.size() < 8);
    for (const std::vector<Vec2f>& ring : input.rings) {
        input.views.push_back({ring.data(), static_cast<std::int32_t>(ring.size())});
    }
    return input;
}

void require(bool holds) {
    if (!holds) {
        std::abort();
    }
}

void require_place(const Input& input, std::int32_t ring, std::int32_t edge) {
    require(ring >= -1 && ring < static_cast<std::int32_t>(input.views.size()));
    require(edge >= -1 && (ring >= 0 || edge < 0));
    require(ring < 0 || edge < input.views[static_cast<std::size_t>(ring)].size);
}

/// On the lattice orientation is exact: pieces are convex and have the polygon's area.
void require_pieces(const Input& input) {
    std::vector<weir::Vec2<double>> vertices;
    std::vector<std::uint16_t> ends;
    double whole = 0.0;
    const weir::RingsOnGrid rings({input.outer(), input.holes()});
    for (std::int32_t k = 0; k < rings.count(); ++k) {
        const std::size_t first = vertices.size();
        weir::copy_ring(rings, k, [&](Vec2f v) {
            vertices.push_back(weir::convert<double>(v));
        });
        ends.push_back(static_cast<std::uint16_t>(vertices.size()));
        require(vertices.size() >= first + 3);
        whole += weir::twice_signed_area(vertices.data() + first,
                                         static_cast<std::int32_t>(vertices.size() - first));
    }
    const weir::Outline<double> outline{vertices.data(),
                                        static_cast<std::int32_t>(vertices.size()),
                                        static_cast<std::int32_t>(ends.size()), ends.data()};
    const auto corners = static_cast<std::size_t>(weir::corner_count(outline));
    std::vector<std::uint16_t> scratch(5 * corners);
    std::vector<std::uint16_t> pieces(4 * (corners - 2));
    const std::int32_t used =
        weir::decompose(outline, {scratch.data(), static_cast<std::int32_t>(scratch.size())},
                        {pieces.data(), static_cast<std::int32_t>(pieces.size())});
    double covered = 0.0;
    for (std::int32_t at = 0; at < used;) {
        const std::uint16_t* piece = pieces.data() + at + 1;
        const std::int32_t count = pieces[static_cast<std::size_t>(at)];
        require(count >= 3);
        for (std::int32_t k = 0; k < count; ++k) {
            require(piece[k] < vertices.size());
            const weir::Vec2<double> a = vertices[piece[k]];
            const weir::Vec2<double> b = vertices[piece[(k + 1) % count]];
            const weir::Vec2<double> c = vertices[piece[(k + 2) % count]];
            require(weir::turn(a, b, c) > 0.0);
            covered += weir::cross(a, b);
        }
        at += 1 + count;
    }
    require(covered == whole);
}

template <class Real>
void try_in_world(const Input& input, const Options& options, Bytes& pose, Status checked) {
    weir::WorldDef def;
    def.cell_m = 1.0F;
    def.capacity.particles = 16;
    def.capacity.cells_x = 6;
    def.capacity.cells_y = 6;
    def.capacity.bodies = 2;
    def.capacity.vertices = 160;
    def.pressure_sweeps = 1;
    def.max_substeps = 2;
    def.contour = options.binary ? weir::Contour::mid_edge : weir::Contour::interpolated;
    constexpr std::size_t kRoom = 32 * 1024;
    alignas(weir::world_alignment) static std::byte memory[kRoom];
    weir::World<Real> world;
    require(world.init(def, memory) == Status::ok);
    require(world.fill({{1.0F, 1.0F}, {3.0F, 3.0F}}) == Status::ok);
    const std::uint64_t before = world.state_hash();
    weir::BodyDef body;
    body.polygon = input.outer();
    body.holes = input.holes();
    body.motion.position_m = {3.0F + pose.eighth(), 3.0F + pose.eighth()};
    body.motion.angle_rad = pose.eighth();
    body.motion.velocity_mps = {pose.eighth(), pose.eighth()};
    body.motion.spin_radps = pose.eighth();
    weir::BodyId id;
    const Status added = options.moving ? world.add_moving_body(body, &id)
                                        : world.add_static_body(body, &id);
    require(checked == Status::ok || added == checked);
    if (added != Status::ok) {
        require(world.state_hash() == before);
        return;
    }
    world.step(0.02F);
    require(world.remove_body(id) == Status::ok);
    world.step(0.02F);
    for (const weir::Vec2<Real>& x : world.particle_positions()) {
        require(x.x > Real(0) && x.x < Real(6) && x.y > Real(0) && x.y < Real(6));
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes(data, size);
    const Options options = options_of(bytes.byte());
    Bytes pose = bytes;
    if (options.world) {
        for (int k = 0; k < 6; ++k) {
            bytes.byte();
        }
    }
    const Input input = read_rings(bytes, options.any_float);
    weir::PolygonFault fault;
    const Status status = weir::check_polygon(input.outer(), input.holes(), &fault);
    require_place(input, fault.ring_a, fault.edge_a);
    require_place(input, fault.ring_b, fault.edge_b);
    if (status == Status::ok && !options.any_float) {
        require_pieces(input);
    }
    if (options.world && options.in_double) {
        try_in_world<double>(input, options, pose, status);
    } else if (options.world) {
        try_in_world<float>(input, options, pose, status);
    }
    return 0;
}
