#include "engine/geometry/mesh_file.h"

#include <gmock/gmock.h>

#include <cstdint>
#include <cstring>

#include "engine/core/diagnostics.h"
#include "tests/unit/geometry/support.h"

namespace pedicel::geometry {
namespace {

using testing::HasSubstr;

/// A binary STL that says it has `said` triangles and has `count`.
std::string binary_stl(std::uint32_t said, std::size_t count, const std::string& head = "pedicel") {
  std::string bytes = head + std::string(80 - head.size(), ' ');
  bytes.append(reinterpret_cast<const char*>(&said), sizeof said);
  for (std::size_t i = 0; i < count; ++i) {
    const float corner = static_cast<float>(i);
    const float numbers[12] = {0, 0, 1, corner, 0, 0, corner + 1, 0, 0, corner, 1, 0};
    bytes.append(reinterpret_cast<const char*>(numbers), sizeof numbers);
    bytes.append(2, '\0');
  }
  return bytes;
}

std::string fault(const std::string& name, const std::string& bytes) {
  const TemporaryFolder folder;
  const auto path = folder.write(name, bytes);
  const std::string said = mesh_file_fault(path).value_or("");
  if (said.empty()) {
    EXPECT_FALSE(load_mesh(path).triangles.empty());
  } else {
    EXPECT_THROW(load_mesh(path), InvalidFile);
  }
  return said;
}

const std::string facet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";

TEST(MeshFile, WholeFilesHaveNoFault) {
  EXPECT_EQ(fault("a.stl", binary_stl(12, 12)), "");
  EXPECT_EQ(fault("a.STL", binary_stl(12, 12, "solid of a CAD")), "");
  EXPECT_EQ(fault("a.stl", "solid a\n" + facet + "endsolid a\n"), "");
  EXPECT_EQ(fault("a.stl", "solid\n" + facet), "");  // some writers leave the end out
}

TEST(MeshFile, NamesWhatIsMissingOfAnStl) {
  EXPECT_EQ(fault("a.stl", binary_stl(12, 12).substr(0, 300)),
            "cut off: 300 of 684 bytes (12 triangles)");
  EXPECT_EQ(fault("a.stl", binary_stl(12, 12).substr(0, 60)),
            "cut off: 60 bytes, expected at least 84");
  EXPECT_EQ(fault("a.stl", binary_stl(3, 12)),
            "wrong count: 3 triangles take 234 bytes, the file has 684");
  EXPECT_EQ(fault("a.stl", binary_stl(0, 0)), "no triangles, expected at least one with an area");
  EXPECT_THAT(fault("a.stl", "solid a\n" + facet + "facet normal 0 0 1\nouter loop\nvertex 0"),
              HasSubstr("cut off in the midst of a facet"));
}

TEST(MeshFile, NamesWhatIsThereInPlaceOfAMesh) {
  for (const std::string name : {"a.stl", "a.dae", "a.obj"}) {
    EXPECT_EQ(fault(name, "version https://git-lfs.github.com/spec/v1\noid sha256:aa\nsize 9\n"),
              "a Git LFS pointer: run git lfs pull");
    EXPECT_EQ(fault(name, ""), "an empty file, expected a mesh");
    EXPECT_EQ(fault(name, std::string("PK\x03\x04") + std::string(300, 'x')),
              "a zip archive, expected a mesh: unpack it first");
    EXPECT_EQ(fault(name, "\x89PNG\r\n" + std::string(300, 'x')),
              "a PNG image, expected a mesh: export one as STL");
    EXPECT_THAT(fault(name, "<!DOCTYPE html>\n<html>"), HasSubstr("a web page, expected a mesh"));
  }
}

}  // namespace
}  // namespace pedicel::geometry
