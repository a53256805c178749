#include "polygon_list.hpp"

#include <cstdio>
#include <stdexcept>

namespace solids {

std::size_t ListedPolygon::vertices() const {
    std::size_t sum = 0;
    for (const auto& ring : rings) {
        sum += ring.size();
    }
    return sum;
}

std::vector<ListedPolygon> list_polygons(const std::string& arguments) {
    const std::string command = std::string(WEIR_PYTHON3 " " WEIR_REAL_POLYGONS " ") + arguments;
    std::FILE* pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) {
        throw std::runtime_error("cannot run " + command);
    }
    std::vector<ListedPolygon> list;
    char name[256];
    int rings = 0;
    int sound = 0;
    while (std::fscanf(pipe, " polygon %255s %d %d", name, &rings, &sound) == 3) {
        ListedPolygon polygon;
        polygon.name = name;
        polygon.sound = sound == 1;
        for (int k = 0; k < rings; ++k) {
            int count = 0;
            std::vector<weir::Vec2f> ring;
            for (int i = std::fscanf(pipe, " ring %d", &count) == 1 ? 0 : count; i < count; ++i) {
                weir::Vec2f v;
                if (std::fscanf(pipe, "%f %f", &v.x, &v.y) == 2) {
                    ring.push_back(v);
                }
            }
            polygon.rings.push_back(ring);
        }
        list.push_back(polygon);
    }
    if (pclose(pipe) != 0 || list.empty()) {
        throw std::runtime_error(command + " failed: toolchains/install geometry");
    }
    return list;
}

weir::BodyDef body_of(const ListedPolygon& polygon, std::vector<weir::View<weir::Vec2f>>& views) {
    views.clear();
    for (const auto& ring : polygon.rings) {
        views.push_back({ring.data(), static_cast<std::int32_t>(ring.size())});
    }
    weir::BodyDef def;
    def.polygon = views[0];
    def.holes = {views.data() + 1, static_cast<std::int32_t>(views.size()) - 1};
    return def;
}

}  // namespace solids
