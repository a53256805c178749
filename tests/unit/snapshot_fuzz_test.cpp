// Snapshots from an enemy: any bytes, also behind a checksum that fits. They are refused or
// restored, and what was restored can be stepped, changed and removed; the sanitizers watch.
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "busy_world.hpp"

namespace weir {
namespace {

using Bytes = std::vector<std::byte>;

/// Of the format, see weir/snapshot.hpp.
constexpr std::size_t kLengthAt = 8;
constexpr std::size_t kHeadBytes = 40;
constexpr std::size_t kChecksumBytes = 8;

std::uint32_t word_at(const Bytes& bytes, std::size_t at) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data() + at, sizeof word);
    return word;
}

void set_word(Bytes& bytes, std::size_t at, std::uint32_t word) {
    std::memcpy(bytes.data() + at, &word, sizeof word);
}

/// Makes length and checksum those of the contents.
void forge(Bytes& bytes) {
    const std::uint64_t length = bytes.size();
    std::memcpy(bytes.data() + kLengthAt, &length, sizeof length);
    std::uint64_t sum = 0xCBF29CE484222325ULL;
    const std::size_t end = bytes.size() - kChecksumBytes;
    for (std::size_t at = 0; at < end; at += 4) {
        sum = (sum ^ word_at(bytes, at)) * 0x100000001B3ULL;
    }
    std::memcpy(bytes.data() + end, &sum, sizeof sum);
}

std::uint32_t nasty_word(Dice& dice, std::uint32_t old) {
    constexpr std::uint32_t kNasty[] = {0U,          1U,          2U,          3U,
                                        0xFFFFFFFFU, 0x80000000U, 0x7FFFFFFFU, 0x7FC00000U,
                                        0x7F800000U, 0xFF800000U, 0x7F7FFFFFU, 0x58635FA9U,
                                        0x41900000U, 0x418FFFFFU, 0x00000001U, 0x0000FFFFU};
    switch (dice.below(5)) {
        case 0: return kNasty[dice.below(16)];
        case 1: return old + 1U;
        case 2: return old - 1U;
        case 3: return old ^ (1U << dice.below(32));
        default: return static_cast<std::uint32_t>(dice.bits());
    }
}

std::size_t any_word(Dice& dice, const Bytes& bytes) {
    const auto words = static_cast<std::int32_t>((bytes.size() - kHeadBytes - kChecksumBytes) / 4);
    // The first ones, which say how much there is of everything, more often than the rest.
    const std::int32_t word = dice.below(2) == 0 ? dice.below(words < 90 ? words : 90)
                                                 : dice.below(words);
    return kHeadBytes + 4 * static_cast<std::size_t>(word);
}

void spoil(Bytes& bytes, const Bytes& other, Dice& dice) {
    const std::int32_t times = 1 + dice.below(4);
    for (std::int32_t k = 0; k < times && bytes.size() > kHeadBytes + kChecksumBytes + 4; ++k) {
        const std::size_t at = any_word(dice, bytes);
        const auto place = bytes.begin() + static_cast<std::ptrdiff_t>(at);
        switch (dice.below(12)) {
            case 0: bytes.erase(place, place + 4); break;
            case 1: bytes.insert(place, 4, std::byte{0}); break;
            case 2: bytes.resize(at + kChecksumBytes); break;
            case 3:
                if (at < other.size()) {  // on with another one's
                    bytes.resize(at);
                    bytes.insert(bytes.end(), other.begin() + static_cast<std::ptrdiff_t>(at),
                                 other.end());
                }
                break;
            default: set_word(bytes, at, nasty_word(dice, word_at(bytes, at))); break;
        }
    }
    if (dice.below(8) != 0) {
        forge(bytes);
    }
}

/// Uses everything that a snapshot could have made point elsewhere.
template <class Real>
void use(World<Real>& world, Dice& dice) {
    world.step(1.0F / 60.0F);
    EXPECT_TRUE(all_inside(world));
    live(world, dice, 2);
    BodyId id;
    for (std::int32_t slot = 0; slot < 5; ++slot) {
        if (world.body_in_slot(slot, &id) == Status::ok) {
            EXPECT_EQ(world.remove_body(id), Status::ok);
        }
    }
    put_body(world, dice);
    world.step(1.0F / 60.0F);
    EXPECT_TRUE(all_inside(world));
}

/// Three more kinds: one stores a window only, in one regions sleep, in one are free bodies.
constexpr std::int32_t kWindowKind = kBusyKinds;
constexpr std::int32_t kRegionsKind = kBusyKinds + 1;
constexpr std::int32_t kFreeKind = kBusyKinds + 2;
constexpr std::int32_t kKinds = kBusyKinds + 3;

template <class Real>
bool is_borne(std::int32_t kind) {
    const bool only_roomy = kind == kWindowKind || kind == kFreeKind;
    return kind < kBusyKinds ? busy_kind_is_borne<Real>(kind)
                             : !only_roomy || !std::is_same_v<Real, SmallFixed>;
}

WorldDef small_def(std::int32_t kind) {
    WorldDef def = busy_def(kind);
    if (kind == kWindowKind) {
        def.capacity.cells_x = 90;
        def.capacity.cells_y = 60;
        def.capacity.window_cells = 66 * 26;
    }
    if (kind == kRegionsKind) {
        def.capacity.cells_x = 40;
        def.capacity.sleeping_regions = true;
        def.sleep.speed_mps = 0.05F;
        def.sleep.after_s = 0.2F;
    }
    def.capacity.two_way = kind == kFreeKind;
    def.capacity.particles = 60;
    def.max_substeps = 2;
    def.pressure_sweeps = 2;
    return def;
}

/// Two puddles and a divider. The right one falls asleep, above the left one a body turns.
template <class Real>
void fall_asleep(World<Real>& world) {
    BodyDef spinner = body_of(kSquare4cm, {0.1F, 0.2F});
    spinner.motion.spin_radps = 1.0F;
    const Ring divider = rectangle(0.2F, 0.28F);
    put_moving(world, spinner);
    put_static(world, body_of(divider, {0.4F, 0.0F}));
    EXPECT_EQ(world.fill({{0.7F, 0}, {0.8F, 0.02F}}), Status::ok);
    StepReport report;
    for (int step = 0; step < 600 && report.particles_asleep == 0; ++step) {
        report = world.step(1.0F / 60.0F);
    }
    EXPECT_GT(report.particles_asleep, 0);
}

/// A raft, a flap and a slide.
template <class Real>
void put_free_bodies(World<Real>& world) {
    const Ring raft = rectangle(0.06F, 0.04F);
    BodyDef def = body_of(raft, {0.05F, 0.05F}, 0.1F);
    def.density_ratio = 0.6F;
    put_free(world, def);
    def = body_of(kTriangle, {0.12F, 0.1F}, 0.3F);
    def.hold = Hold::hinge;
    put_free(world, def);
    def = body_of(kSquare4cm, {0.25F, 0.1F}, -0.4F);
    def.hold = Hold::rail_x;
    put_free(world, def);
}

/// Of a world that has lived a while.
template <class Real>
Bytes saved(World<Real>& world, const WorldDef& def, Dice& dice) {
    EXPECT_EQ(world.fill({{0, 0}, {0.05F, 0.05F}}), Status::ok);
    if (def.capacity.sleeping_regions) {
        EXPECT_EQ(world.let_regions_sleep(), Status::ok);
        fall_asleep(world);
    } else {
        if (def.capacity.two_way) {
            put_free_bodies(world);
        }
        live(world, dice, 25);
    }
    return saved(world, def.capacity);
}

template <class Real>
std::int64_t attack(std::int32_t kind, std::int64_t times, std::uint64_t seed) {
    const WorldDef def = small_def(kind);
    TestWorld<Real> world(def);
    Dice dice(seed);
    Bytes snapshot[2];
    for (Bytes& bytes : snapshot) {
        bytes = saved(*world, def, dice);
        EXPECT_EQ(world.init_again(), Status::ok);
    }
    std::int64_t restored = 0;
    std::uint64_t hash = world->state_hash();
    for (std::int64_t time = 0; time < times; ++time) {
        Bytes bytes = snapshot[dice.below(2)];
        spoil(bytes, snapshot[dice.below(2)], dice);
        if (world->restore(bytes.data(), bytes.size()) == Status::ok) {
            ++restored;
            use(*world, dice);
            EXPECT_EQ(world->restore(snapshot[0].data(), snapshot[0].size()), Status::ok);
            hash = world->state_hash();
        } else if (time % 64 == 0) {
            EXPECT_EQ(world->state_hash(), hash) << "a refused snapshot changed the world";
        }
        if (testing::Test::HasFailure()) {
            std::printf("kind %d seed %llu time %lld\n", kind,
                        static_cast<unsigned long long>(seed), static_cast<long long>(time));
            break;
        }
    }
    return restored;
}

template <class Real>
class ForgedBelts : public testing::Test {};
using EveryReal = testing::Types<float, double, Fixed, SmallFixed>;
TYPED_TEST_SUITE(ForgedBelts, EveryReal, ScalarNumber);

// On packed faces twice the speed of one that had the largest number there is overflowed.
TYPED_TEST(ForgedBelts, AreRefusedThatAreFasterThanAnything) {
    WorldDef def = tank_def(8, 8, 40);
    def.walls.bottom.no_slip = true;
    def.walls.bottom.conveyor_mps = 37.25F * def.cell_m;
    def.viscosity_m2ps = 1.0e-4F;
    TestWorld<TypeParam> world(def);
    const Bytes snapshot = saved(*world, def.capacity);
    int found = 0;
    for (std::size_t at = kHeadBytes; at + sizeof(TypeParam) < snapshot.size() - kChecksumBytes;
         at += 4) {
        TypeParam number;
        std::memcpy(&number, snapshot.data() + at, sizeof number);
        if (std::fabs(static_cast<double>(number) - 37.25) < 1e-4) {
            Bytes bytes = snapshot;
            number = TypeParam(std::is_floating_point_v<TypeParam> ? 3.0e6F : 32767.0F);
            std::memcpy(bytes.data() + at, &number, sizeof number);
            forge(bytes);
            EXPECT_NE(world->restore(bytes.data(), bytes.size()), Status::ok);
            ++found;
        }
    }
    EXPECT_EQ(found, 1);
    EXPECT_EQ(world->restore(snapshot.data(), snapshot.size()), Status::ok);
}

/// WEIR_SNAPSHOTS: how many are forged in all.
const char* wanted() { return std::getenv("WEIR_SNAPSHOTS"); }

/// Every word of a snapshot becomes a number that is finite and absurd.
template <class Real>
void make_absurd(std::int32_t kind) {
    const WorldDef def = small_def(kind);
    TestWorld<Real> world(def);
    Dice dice(7);
    const Bytes snapshot = saved(*world, def, dice);
    std::int64_t refused = 0;
    const std::size_t stride = kSanitized && wanted() == nullptr ? 28 : 4;
    for (std::size_t at = kHeadBytes; at + 4 <= snapshot.size() - kChecksumBytes; at += stride) {
        Bytes bytes = snapshot;
        set_word(bytes, at, 0x5368D4A5U);  // 1e12F, and as a double's upper word 1e93
        forge(bytes);
        if (world->restore(bytes.data(), bytes.size()) == Status::ok) {
            use(*world, dice);
        } else {
            ++refused;
        }
        if (testing::Test::HasFailure()) {
            std::printf("kind %d byte %zu\n", kind, at);
            break;
        }
    }
    EXPECT_GT(refused, 0) << "the test no longer gets behind the checksum";
}

TEST(SnapshotFuzz, NoAbsurdNumberGetsPast) {
    for (std::int32_t kind = 0; kind < kKinds; ++kind) {
        make_absurd<float>(kind);
        make_absurd<double>(kind);
    }
}

TEST(SnapshotFuzz, NothingGetsPast) {
    const std::int64_t times = wanted() != nullptr ? std::atoll(wanted()) : 10000;
    std::int64_t restored = 0;
    for (std::int32_t kind = 0; kind < kKinds; ++kind) {
        restored += attack<float>(kind, times / kKinds / 2, 1);
        restored += attack<double>(kind, times / kKinds / 4, 2);
        restored += attack<Fixed>(kind, times / kKinds / 4, 3);
        if (is_borne<SmallFixed>(kind)) {
            restored += attack<SmallFixed>(kind, times / kKinds / 4, 4);
        }
    }
    std::printf("%lld forged snapshots, %lld restored\n", static_cast<long long>(times),
                static_cast<long long>(restored));
    EXPECT_GT(restored, times / 100) << "the test no longer gets behind the checksum";
}

}  // namespace
}  // namespace weir
