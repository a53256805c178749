// Polygons that real_polygons.py takes out of installed packages.
#pragma once

#include <string>
#include <vector>

#include "weir/weir.hpp"

namespace solids {

struct ListedPolygon {
    std::string name;
    std::vector<std::vector<weir::Vec2f>> rings;  ///< the outer one first
    bool sound = true;  ///< by shapely's judgement: rings simple and apart

    std::size_t vertices() const;
};

/// @param arguments of the script: coast, letters, or icons and a number.
/// Throws if the script fails: a package is missing.
std::vector<ListedPolygon> list_polygons(const std::string& arguments);

/// A definition whose rings are those of `views`, which it fills; no motion.
weir::BodyDef body_of(const ListedPolygon& polygon, std::vector<weir::View<weir::Vec2f>>& views);

}  // namespace solids
