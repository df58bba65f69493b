#include "engine/render/image.h"

#include <png.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>

#include "engine/core/check.h"
#include "engine/core/diagnostics.h"

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

namespace {

struct PngKind {
  int width, height, bits, colour;
};

/// Rows are given as their bytes.
template <class Row>
std::vector<std::uint8_t> encode(const PngKind& kind, const Row& row) {
  if (kind.width < 1 || kind.height < 1)
    throw UsageError("Image of " + std::to_string(kind.width) + " x " +
                     std::to_string(kind.height) + " px: must be at least 1 x 1");
  std::vector<std::uint8_t> bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, refuse, ignore);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(png, &bytes, append, nullptr);
  png_set_IHDR(png, info, kind.width, kind.height, kind.bits, kind.colour, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  // Smooth shading: the difference to the row above packs well, and trying every filter for every
  // row costs more than it saves.
  png_set_filter(png, PNG_FILTER_TYPE_DEFAULT, PNG_FILTER_UP);
  png_set_compression_level(png, 5);
  png_write_info(png, info);
  for (int y = 0; y < kind.height; ++y) png_write_row(png, row(y));
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

}  // namespace

std::vector<std::uint8_t> encode_png(const Image& image) {
  return encode({image.width, image.height, 8, PNG_COLOR_TYPE_RGB},
                [&](int y) { return image.at(0, y); });
}

std::vector<std::uint8_t> encode_png(const GrayImage& image, int bits) {
  const auto width = static_cast<std::size_t>(image.width);
  std::vector<std::uint8_t> bytes(width * 2);
  return encode({image.width, image.height, bits, PNG_COLOR_TYPE_GRAY}, [&](int y) {
    const std::uint16_t* from = image.values.data() + width * static_cast<std::size_t>(y);
    for (std::size_t x = 0; x < width; ++x) {
      const auto high = static_cast<std::uint8_t>(from[x] >> 8);
      const auto low = static_cast<std::uint8_t>(from[x] & 255u);
      if (bits == 8)
        bytes[x] = low;
      else
        bytes[2 * x] = high, bytes[2 * x + 1] = low;  // PNG's order
    }
    return bytes.data();
  });
}

namespace {

// Without waiting for the disk, as io::write_file_atomically() does: films have many pictures.
void write_bytes(const std::filesystem::path& path, const std::vector<std::uint8_t>& bytes) {
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
  // Renaming would put a plain file in the place of a device or a pipe.
  if (std::filesystem::is_other(path)) fail("is a device or a pipe, expected a plain file");
  std::filesystem::rename(part, path, error);
  if (error) fail(error.message());
}

}  // namespace

void write_png(const std::filesystem::path& path, const Image& image) {
  write_bytes(path, encode_png(image));
}

void write_png(const std::filesystem::path& path, const GrayImage& image, int bits) {
  write_bytes(path, encode_png(image, bits));
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

namespace {

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
[[noreturn]] void refuse_reading(png_structp, png_const_charp what) {
  throw std::runtime_error(what);
}
struct Reading {
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, refuse_reading, ignore);
  png_infop info = png_create_info_struct(png);
  ~Reading() { png_destroy_read_struct(&png, &info, nullptr); }
};

GrayImage read_gray(std::FILE* file) {
  constexpr png_uint_32 most = 16384;  // px, of a side
  Reading reading;
  png_init_io(reading.png, file);
  png_set_user_limits(reading.png, most, most);
  png_read_info(reading.png, reading.info);
  const int bits = png_get_bit_depth(reading.png, reading.info);
  if (png_get_color_type(reading.png, reading.info) != PNG_COLOR_TYPE_GRAY ||
      (bits != 8 && bits != 16) ||
      png_get_interlace_type(reading.png, reading.info) != PNG_INTERLACE_NONE)
    throw std::runtime_error("expected gray of 8 or 16 bits, not interlaced");
  GrayImage image(static_cast<int>(png_get_image_width(reading.png, reading.info)),
                  static_cast<int>(png_get_image_height(reading.png, reading.info)));
  std::vector<std::uint8_t> row(png_get_rowbytes(reading.png, reading.info));
  const auto width = static_cast<std::size_t>(image.width);
  for (int y = 0; y < image.height; ++y) {
    png_read_row(reading.png, row.data(), nullptr);
    std::uint16_t* to = image.values.data() + width * static_cast<std::size_t>(y);
    for (std::size_t x = 0; x < width; ++x)
      to[x] = bits == 8 ? row[x] : static_cast<std::uint16_t>(row[2 * x] << 8 | row[2 * x + 1]);
  }
  return image;
}

}  // namespace

GrayImage read_gray_png(const std::filesystem::path& path) {
  const std::unique_ptr<std::FILE, FileCloser> file(std::fopen(path.c_str(), "rb"));
  if (!file)
    throw InvalidFile({path.string()}, std::string("cannot be read: ") + std::strerror(errno));
  try {
    return read_gray(file.get());
  } catch (const std::runtime_error& fault) {
    throw InvalidFile({path.string()}, std::string("cannot be read as PNG: ") + fault.what());
  }
}

}  // namespace pedicel::render
