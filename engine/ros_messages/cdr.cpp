#include "engine/ros_messages/cdr.h"

namespace pedicel::ros {

CdrReader::CdrReader(std::string_view bytes) : FieldReader(bytes) {
  // Of the kinds of CDR only the plain one: 0 big-endian, 1 little-endian.
  good_ = bytes.size() >= cdr_header_size && bytes[0] == 0 && (bytes[1] == 0 || bytes[1] == 1);
  if (!good_) return;
  swapped_ = bytes[1] == 0;
  bytes_ = bytes.substr(cdr_header_size);
}

void CdrReader::align(std::size_t size) {
  const std::size_t over = at_ % size;
  if (over == 0) return;
  if (left() < size - over) return fail();
  at_ += size - over;
}

void CdrReader::text(std::string& value) {
  std::uint32_t size = 0;
  number(size);
  // A text without its closing zero byte is not in order, but an empty one is seen to be sent so.
  if (!good_ || size > left()) return fail();
  if (size == 0) return value.clear();
  if (bytes_[at_ + size - 1] != '\0') return fail();
  value.assign(bytes_.substr(at_, size - 1));
  at_ += size;
}

}  // namespace pedicel::ros
