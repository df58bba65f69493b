#include "app/h5/h5_file.h"

#include <algorithm>

#include "engine/io/atomic_file.h"

namespace pedicel::app {

namespace {

constexpr std::size_t block = 64 * 1024;  // bytes that are gathered
constexpr unsigned level = 1;             // of deflate

hid_t type_of(H5File::Kind kind) {
  switch (kind) {
    case H5File::Kind::single:
      return H5T_NATIVE_FLOAT;
    case H5File::Kind::byte:
      return H5T_NATIVE_UINT8;
    case H5File::Kind::word:
      return H5T_NATIVE_UINT16;
    default:
      return H5T_NATIVE_DOUBLE;
  }
}

std::vector<hsize_t> with_rows(hsize_t rows, const std::vector<hsize_t>& shape) {
  std::vector<hsize_t> all{rows};
  all.insert(all.end(), shape.begin(), shape.end());
  return all;
}

}  // namespace

H5File::H5File(const std::filesystem::path& path) : name_(path.string()) {
  // What goes wrong is told here, not by the library.
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  file_ = good(H5Fcreate(name_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  text_ = good(H5Tcopy(H5T_C_S1));
  H5Tset_size(text_, H5T_VARIABLE);
  H5Tset_cset(text_, H5T_CSET_UTF8);
  with_groups_ = good(H5Pcreate(H5P_LINK_CREATE));
  H5Pset_create_intermediate_group(with_groups_, 1);
}

H5File::~H5File() {
  for (auto& [path, one] : all_) H5Dclose(one.set);
  if (with_groups_ >= 0) H5Pclose(with_groups_);
  if (text_ >= 0) H5Tclose(text_);
  if (file_ >= 0) H5Fclose(file_);
}

void H5File::fail() const {
  throw io::WriteError(name_ + ": cannot be written");
}

hid_t H5File::good(hid_t id) const {
  if (id < 0) fail();
  return id;
}

H5File::Series& H5File::series(const std::string& path, hid_t type,
                               const std::vector<hsize_t>& shape) {
  const auto known = all_.find(path);
  if (known != all_.end()) {
    if (known->second.shape != shape) fail();
    return known->second;
  }
  Series one;
  one.type = type;
  one.shape = shape;
  one.row_bytes = H5Tget_size(type);
  for (const hsize_t extent : shape) one.row_bytes *= extent;
  const int rank = static_cast<int>(shape.size()) + 1;
  const auto begin = with_rows(0, shape), most = with_rows(H5S_UNLIMITED, shape),
             chunk = with_rows(
                 std::max<hsize_t>(1, block / std::max<std::size_t>(1, one.row_bytes)), shape);
  const hid_t space = good(H5Screate_simple(rank, begin.data(), most.data()));
  const hid_t how = good(H5Pcreate(H5P_DATASET_CREATE));
  H5Pset_chunk(how, rank, chunk.data());
  if (type != text_) H5Pset_deflate(how, level);
  one.set = H5Dcreate2(file_, path.c_str(), type, space, with_groups_, how, H5P_DEFAULT);
  H5Pclose(how);
  H5Sclose(space);
  good(one.set);
  return all_[path] = one;
}

void H5File::write_rows(Series& one, hsize_t rows, const void* data) {
  const int rank = static_cast<int>(one.shape.size()) + 1;
  const auto size = with_rows(one.rows + rows, one.shape), count = with_rows(rows, one.shape);
  std::vector<hsize_t> start(size.size(), 0);
  start[0] = one.rows;
  if (H5Dset_extent(one.set, size.data()) < 0) fail();
  const hid_t in_file = good(H5Dget_space(one.set));
  const hid_t in_memory = good(H5Screate_simple(rank, count.data(), nullptr));
  H5Sselect_hyperslab(in_file, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr);
  const herr_t code = H5Dwrite(one.set, one.type, in_memory, in_file, H5P_DEFAULT, data);
  H5Sclose(in_memory);
  H5Sclose(in_file);
  if (code < 0) fail();
  one.rows += rows;
}

void H5File::write(Series& one) {
  if (one.gathered.empty()) return;
  write_rows(one, one.gathered.size() / one.row_bytes, one.gathered.data());
  one.gathered.clear();
}

void H5File::append(const std::string& path, Kind kind, const std::vector<hsize_t>& shape,
                    const void* row) {
  Series& one = series(path, type_of(kind), shape);
  one.gathered.append(static_cast<const char*>(row), one.row_bytes);
  if (one.gathered.size() >= block) write(one);
}

void H5File::append(const std::string& path, const std::vector<double>& row) {
  if (!row.empty()) append(path, Kind::number, {row.size()}, row.data());
}

void H5File::append_text(const std::string& path, const std::string& text) {
  const char* const bytes = text.c_str();
  write_rows(series(path, text_, {}), 1, &bytes);
}

hid_t H5File::group(const std::string& path) {
  if (path == "/") return good(H5Gopen2(file_, "/", H5P_DEFAULT));
  const hid_t known = H5Gopen2(file_, path.c_str(), H5P_DEFAULT);
  if (known >= 0) return known;
  return good(H5Gcreate2(file_, path.c_str(), with_groups_, H5P_DEFAULT, H5P_DEFAULT));
}

void H5File::set(const std::string& path, const std::string& name, hid_t space, const void* data) {
  const hid_t at = group(path);
  if (H5Aexists(at, name.c_str()) == 0) {
    const hid_t one = good(H5Acreate2(at, name.c_str(), text_, space, H5P_DEFAULT, H5P_DEFAULT));
    const herr_t code = H5Awrite(one, text_, data);
    H5Aclose(one);
    if (code < 0) fail();
  }
  H5Gclose(at);
  H5Sclose(space);
}

void H5File::set_attribute(const std::string& path, const std::string& name,
                           const std::string& text) {
  const char* const bytes = text.c_str();
  set(path, name, good(H5Screate(H5S_SCALAR)), &bytes);
}

void H5File::set_attribute(const std::string& path, const std::string& name,
                           const std::vector<std::string>& texts) {
  if (texts.empty()) return;
  std::vector<const char*> all;
  for (const std::string& text : texts) all.push_back(text.c_str());
  const hsize_t count = all.size();
  set(path, name, good(H5Screate_simple(1, &count, nullptr)), all.data());
}

void H5File::close() {
  for (auto& [path, one] : all_) write(one);
  if (H5Fflush(file_, H5F_SCOPE_LOCAL) < 0) fail();
}

}  // namespace pedicel::app
