#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace pedicel::render {

/// A picture or a video could not be written; exit code 6.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// 8-bit sRGB, rows from the top, no padding.
struct Image {
  int width = 0, height = 0;      ///< px
  std::vector<std::uint8_t> rgb;  ///< height x width x 3

  Image() = default;
  Image(int w, int h)
      : width(w), height(h), rgb(static_cast<std::size_t>(w) * static_cast<std::size_t>(h) * 3) {}

  /// The three bytes of a pixel inside the picture.
  std::uint8_t* at(int x, int y) {
    return rgb.data() + 3 * (static_cast<std::size_t>(y) * width + x);
  }
  const std::uint8_t* at(int x, int y) const {
    return rgb.data() + 3 * (static_cast<std::size_t>(y) * width + x);
  }
};

/// One number a pixel, rows from the top: labels, classes, millimetres.
struct GrayImage {
  int width = 0, height = 0;          ///< px
  std::vector<std::uint16_t> values;  ///< height x width

  GrayImage() = default;
  GrayImage(int w, int h)
      : width(w), height(h), values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
};

/// A gray PNG of 8 or 16 bits; with 8, values must be below 256.
std::vector<std::uint8_t> encode_png(const GrayImage& image, int bits = 16);
/// As for colours below.
void write_png(const std::filesystem::path& path, const GrayImage& image, int bits = 16);

/// The PNG file as bytes (for embedding into a page).
std::vector<std::uint8_t> encode_png(const Image& image);

/// Writes beside the target, then renames: nobody sees half a picture. Creates missing parent
/// folders. Throws OutputError with the path and the reason.
void write_png(const std::filesystem::path& path, const Image& image);

/// Reads any PNG as 8-bit RGB. Throws InvalidFile.
Image read_png(const std::filesystem::path& path);
/// Reads a gray PNG of 8 or 16 bits as its numbers. Throws InvalidFile, for one with colours, too.
GrayImage read_gray_png(const std::filesystem::path& path);

}  // namespace pedicel::render
