#include <png.h>

#include "weir_picture/image_file.hpp"

namespace weir_picture {

bool write_png(const std::string& path, const Canvas& canvas, std::string* error) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(canvas.width());
    image.height = static_cast<png_uint_32>(canvas.height());
    image.format = PNG_FORMAT_RGB;
    const bool written =
        png_image_write_to_file(&image, path.c_str(), 0, canvas.bytes().data(), 0, nullptr) != 0;
    if (!written && error != nullptr) {
        *error = "cannot write " + path + ": " + image.message;
    }
    return written;
}

}  // namespace weir_picture
