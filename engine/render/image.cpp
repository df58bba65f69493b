#include "pedicel/render/image.h"

#include <png.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "pedicel/core/check.h"
#include "pedicel/core/diagnostics.h"

namespace pedicel::render {

namespace {

void append(png_structp png, png_bytep data, png_size_t size) {
  auto* bytes = static_cast<std::vector<std::uint8_t>*>(png_get_io_ptr(png));
  bytes->insert(bytes->end(), data, data + size);
}

/// Our encoder's only failures are out of memory and misuse; both end here, not in a longjmp.
[[noreturn]] void refuse(png_structp, png_const_charp what) {
  throw OutputError(std::string("PNG: ") + what);
}
void ignore(png_structp, png_const_charp) {}

}  // namespace

std::vector<std::uint8_t> encode_png(const Image& image) {
  if (image.width < 1 || image.height < 1)
    throw UsageError("Image of " + std::to_string(image.width) + " x " +
                     std::to_string(image.height) + " px: must be at least 1 x 1");
  std::vector<std::uint8_t> bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, refuse, ignore);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(png, &bytes, append, nullptr);
  png_set_IHDR(png, info, image.width, image.height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  // Smooth shading: the difference to the row above packs well, and trying every filter for every
  // row costs more than it saves.
  png_set_filter(png, PNG_FILTER_TYPE_DEFAULT, PNG_FILTER_UP);
  png_set_compression_level(png, 5);
  png_write_info(png, info);
  for (int y = 0; y < image.height; ++y) png_write_row(png, image.at(0, y));
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

// Without waiting for the disk, as io::write_file_atomically() does: films have many pictures.
void write_png(const std::filesystem::path& path, const Image& image) {
  const std::vector<std::uint8_t> bytes = encode_png(image);
  std::error_code error;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), error);
  const std::filesystem::path part = path.string() + ".part" + std::to_string(::getpid());
  const auto fail = [&](const std::string& reason) {
    std::filesystem::remove(part, error);
    throw OutputError(path.string() + ": cannot be written: " + reason);
  };
  std::ofstream file(part, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  if (!file.flush()) fail(std::strerror(errno));
  file.close();
  std::filesystem::rename(part, path, error);
  if (error) fail(error.message());
}

Image read_png(const std::filesystem::path& path) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_file(&header, path.c_str()))
    throw InvalidFile({path.string()}, std::string("cannot be read as PNG: ") + header.message);
  header.format = PNG_FORMAT_RGB;
  Image image(static_cast<int>(header.width), static_cast<int>(header.height));
  if (!png_image_finish_read(&header, nullptr, image.rgb.data(), 0, nullptr))
    throw InvalidFile({path.string()}, std::string("cannot be read as PNG: ") + header.message);
  return image;
}

}  // namespace pedicel::render
