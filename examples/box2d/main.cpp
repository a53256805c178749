// Liquid with free bodies, and joints between them: box2d_raft SHEET.png ANIMATION.gif
// The library solves for liquid, free bodies and what these meet as one system; of joints it knows
// nothing. Box2D does the raft's hinge: every frame it gets the way that the planks went, and gives
// back poses and velocities. To hand forces over instead, a frame late, would throw bodies about
// that are lighter than the liquid which they set in motion.
#include <box2d/box2d.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "weir/weir.hpp"
#include "weir_picture/frame.hpp"
#include "weir_picture/image_file.hpp"

namespace {

constexpr float kCell = 0.025F;
constexpr int kCellsX = 160;
constexpr int kCellsY = 80;
constexpr float kWidth = kCell * kCellsX;
constexpr float kFrame = 1.0F / 60.0F;
constexpr int kFrames = 420;
constexpr float kWood = 0.5F;  ///< density over the liquid's
constexpr float kPi = 3.14159265F;

struct Solid {
    std::vector<weir::Vec2f> ring;
    b2Body* body = nullptr;  ///< null: it has no joint
    weir::BodyId id;
    weir::Motion motion;  ///< at the end of the last frame
    bool fixed = false;
};

void require(weir::Status status) {
    if (status != weir::Status::ok) {
        std::fprintf(stderr, "box2d_raft: %s\n", weir::status_text(status));
        std::exit(1);
    }
}

std::vector<weir::Vec2f> box(float width, float height) {
    const float x = 0.5F * width;
    const float y = 0.5F * height;
    return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
}

weir::Vec2f vec(b2Vec2 v) { return {v.x, v.y}; }

class Scene {
public:
    Scene() : engine_({0.0F, 0.0F}) {  // gravity is the library's
        weir::WorldDef def;
        def.cell_m = kCell;
        weir::Capacity& c = def.capacity;
        c.cells_x = kCellsX, c.cells_y = kCellsY, c.particles = 20000;
        c.bodies = 16, c.vertices = 128, c.two_way = true;
        memory_.resize(weir::world_bytes<float>(c) / sizeof(Line) + 1);
        require(liquid_.init(def, memory_.data(), memory_.size() * sizeof(Line)));

        add({{3.2F, 0}, {4.0F, 0}, {4.0F, 0.5F}}, {0, 0}, Kind::fixed);  // a beach
        const std::vector<weir::Vec2f> crate = box(0.26F, 0.26F);
        for (int row = 0; row < 3; ++row) {
            for (int k = 0; k < 3 - row; ++k) {
                add(crate, {1.9F + 0.28F * static_cast<float>(k) + 0.14F * static_cast<float>(row),
                            0.50F + 0.27F * static_cast<float>(row)}, Kind::alone);
            }
        }
        const std::vector<weir::Vec2f> plank = box(0.40F, 0.08F);
        b2Body* left = add(plank, {1.10F, 0.5F}, Kind::jointed);
        b2Body* right = add(plank, {1.52F, 0.5F}, Kind::jointed);
        b2RevoluteJointDef hinge;
        hinge.Initialize(left, right, {1.31F, 0.5F});
        hinge.enableLimit = true;  // further the planks would be in each other
        hinge.lowerAngle = -0.5F;
        hinge.upperAngle = 0.5F;
        engine_.CreateJoint(&hinge);
        require(liquid_.fill({{0, 0}, {0.6F, 1.2F}}));  // the dam that breaks
        require(liquid_.fill({{0.6F, 0}, {kWidth, 0.4F}}));
    }

    void step() {
        liquid_.step(kFrame);
        for (Solid& solid : solids_) {
            if (solid.body != nullptr) {
                hand_over(solid);
            }
        }
        engine_.Step(kFrame, 8, 3);
        for (Solid& solid : solids_) {
            if (solid.body != nullptr) {
                take_back(solid);
            }
        }
    }

    weir_picture::Canvas draw(int frame, const weir_picture::Style& style) const {
        std::vector<weir_picture::Polygon> polygons;
        for (const Solid& solid : solids_) {
            weir_picture::Polygon polygon;
            polygon.moving = !solid.fixed;
            weir::Motion at;
            require(liquid_.motion(solid.id, &at));
            const float c = std::cos(at.angle_rad);
            const float s = std::sin(at.angle_rad);
            for (const weir::Vec2f p : solid.ring) {
                polygon.points.push_back({(at.position_m.x + (c * p.x - s * p.y)) / kCell,
                                          (at.position_m.y + (s * p.x + c * p.y)) / kCell});
            }
            polygons.push_back(polygon);
        }
        std::vector<float> speed;
        for (const auto& v : liquid_.particle_velocities()) {
            speed.push_back(kCell * std::sqrt(v.x * v.x + v.y * v.y));
        }
        const auto places = liquid_.particle_positions();
        const weir_picture::Particles particles{&places[0].x, &places[0].y, 2, speed.data(),
                                                speed.size()};
        const std::string caption = weir_picture::time_caption(kFrame * static_cast<float>(frame));
        return weir_picture::draw_frame(kCellsX, kCellsY, particles, polygons, caption, style);
    }

private:
    enum class Kind { fixed, alone, jointed };

    b2Body* add(const std::vector<weir::Vec2f>& ring, weir::Vec2f at, Kind kind) {
        Solid solid;
        solid.ring = ring;
        solid.fixed = kind == Kind::fixed;
        solid.motion.position_m = at;
        if (kind == Kind::jointed) {
            solid.body = add_to_engine(ring, at);
        }
        weir::BodyDef body;
        body.polygon = {ring.data(), static_cast<std::int32_t>(ring.size())};
        body.motion = solid.motion;
        body.density_ratio = kWood;
        body.surface.friction = 0.4F;
        require(solid.fixed ? liquid_.add_static_body(body, &solid.id)
                            : liquid_.add_free_body(body, &solid.id));
        solids_.push_back(solid);
        return solid.body;
    }

    /// Of the shape the engine needs the mass; what it meets is the library's.
    b2Body* add_to_engine(const std::vector<weir::Vec2f>& ring, weir::Vec2f at) {
        b2BodyDef def;
        def.type = b2_dynamicBody;
        def.position = {at.x, at.y};
        def.allowSleep = false;
        b2Body* body = engine_.CreateBody(&def);
        std::vector<b2Vec2> points;
        for (const weir::Vec2f p : ring) {
            points.push_back({p.x, p.y});
        }
        b2PolygonShape shape;
        shape.Set(points.data(), static_cast<int>(points.size()));
        body->CreateFixture(&shape, kWood)->SetSensor(true);
        return body;
    }

    /// Where the library took a body is the way that it would go without its joint.
    void hand_over(Solid& solid) {
        weir::Motion now;
        require(liquid_.motion(solid.id, &now));
        const weir::Vec2f from = solid.motion.position_m;
        const weir::Vec2f to = now.position_m;
        solid.body->SetLinearVelocity({(to.x - from.x) / kFrame, (to.y - from.y) / kFrame});
        const float turn = std::remainder(now.angle_rad - solid.motion.angle_rad, 2.0F * kPi);
        solid.body->SetAngularVelocity(turn / kFrame);
        solid.motion = now;
    }

    /// What the engine changed of it, the body does.
    void take_back(Solid& solid) {
        solid.motion.position_m = vec(solid.body->GetPosition());
        solid.motion.angle_rad = solid.body->GetAngle();
        solid.motion.velocity_mps = vec(solid.body->GetLinearVelocity());
        solid.motion.spin_radps = solid.body->GetAngularVelocity();
        require(liquid_.set_motion(solid.id, solid.motion));
    }

    struct alignas(weir::world_alignment) Line {
        std::byte bytes[weir::world_alignment];
    };
    std::vector<Line> memory_;
    weir::World<float> liquid_{};
    b2World engine_;
    std::vector<Solid> solids_;
};

}  // namespace

int main(int argc, char** argv) {
    if (argc < 3) {
        std::fprintf(stderr, "usage: box2d_raft SHEET.png ANIMATION.gif\n");
        return 64;
    }
    Scene scene;
    weir_picture::Style style = weir_picture::style_for(kCellsX, kCellsY, 480);
    style.full_speed = 3.0F;
    std::vector<weir_picture::Canvas> film;
    std::vector<weir_picture::Canvas> sheet;
    for (int frame = 0; frame <= kFrames; ++frame) {
        if (frame % 5 == 0) {
            film.push_back(scene.draw(frame, style));
        }
        if (frame % (kFrames / 8) == 0 && sheet.size() < 9) {
            sheet.push_back(scene.draw(frame, style));
        }
        scene.step();
    }
    std::string error;
    if (!weir_picture::write_png(argv[1], weir_picture::contact_sheet(sheet, 3), &error) ||
        !weir_picture::write_gif(argv[2], film, 8, &error)) {
        std::fprintf(stderr, "box2d_raft: %s\n", error.c_str());
        return 1;
    }
    return 0;
}
