#include "engine/ros_messages/type_hash.h"

#include <algorithm>
#include <bit>

#include "engine/core/joined.h"

namespace pedicel::ros {

namespace {

/// Of FIPS 180-4: fractional parts of the cube roots of the first 64 primes.
constexpr std::array<std::uint32_t, 64> round_constants = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

using Digest = std::array<std::uint32_t, 8>;

void add_block(Digest& digest, const unsigned char* block) {
  std::array<std::uint32_t, 64> w{};
  for (std::size_t i = 0; i < 16; ++i)
    for (std::size_t k = 0; k < 4; ++k) w[i] = (w[i] << 8) | block[4 * i + k];
  for (std::size_t i = 16; i < 64; ++i) {
    const std::uint32_t s0 = std::rotr(w[i - 15], 7) ^ std::rotr(w[i - 15], 18) ^ (w[i - 15] >> 3);
    const std::uint32_t s1 = std::rotr(w[i - 2], 17) ^ std::rotr(w[i - 2], 19) ^ (w[i - 2] >> 10);
    w[i] = w[i - 16] + s0 + w[i - 7] + s1;
  }
  auto [a, b, c, d, e, f, g, h] = digest;
  for (std::size_t i = 0; i < 64; ++i) {
    const std::uint32_t s1 = std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25);
    const std::uint32_t t1 = h + s1 + ((e & f) ^ (~e & g)) + round_constants[i] + w[i];
    const std::uint32_t s0 = std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22);
    const std::uint32_t t2 = s0 + ((a & b) ^ (a & c) ^ (b & c));
    h = g, g = f, f = e, e = d + t1, d = c, c = b, b = a, a = t1 + t2;
  }
  const Digest sums = {a, b, c, d, e, f, g, h};
  for (std::size_t i = 0; i < 8; ++i) digest[i] += sums[i];
}

/// The number that type_description_interfaces gives a type.
int type_id(const std::string& type) {
  if (is_message(type)) return 1;
  constexpr std::pair<const char*, int> known[] = {
      {"int8", 2},  {"uint8", 3},  {"int16", 4},    {"uint16", 5},   {"int32", 6}, {"uint32", 7},
      {"int64", 8}, {"uint64", 9}, {"float32", 10}, {"float64", 11}, {"bool", 15}, {"string", 17}};
  for (const auto& [name, id] : known)
    if (type == name) return id;
  return 0;
}

std::string field_json(const FieldDefinition& field) {
  using Count = FieldDefinition::Count;
  const int shift = field.count == Count::array ? 48 : field.count == Count::sequence ? 144 : 0;
  return "{\"name\": \"" + field.name +
         "\", \"type\": {\"type_id\": " + std::to_string(type_id(field.type) + shift) +
         ", \"capacity\": " + std::to_string(field.size) +
         ", \"string_capacity\": 0, \"nested_type_name\": \"" +
         (is_message(field.type) ? field.type : "") + "\"}}";
}

std::string json_of(const Definition& definition) {
  const std::string fields = joined(definition.fields, field_json);
  return "{\"type_name\": \"" + definition.name + "\", \"fields\": [" + fields + "]}";
}

}  // namespace

std::string sha256(const std::string& bytes) {
  std::string padded = bytes + '\x80';
  while (padded.size() % 64 != 56) padded.push_back('\0');
  const std::uint64_t bits = 8 * std::uint64_t{bytes.size()};
  for (int shift = 56; shift >= 0; shift -= 8) padded.push_back(static_cast<char>(bits >> shift));
  Digest digest = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                   0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  for (std::size_t at = 0; at < padded.size(); at += 64)
    add_block(digest, reinterpret_cast<const unsigned char*>(padded.data()) + at);
  std::string text;
  for (const std::uint32_t word : digest)
    for (int shift = 28; shift >= 0; shift -= 4) text += "0123456789abcdef"[(word >> shift) & 15];
  return text;
}

std::string type_hash(const std::vector<Definition>& definitions) {
  std::vector<Definition> others(definitions.begin() + 1, definitions.end());
  std::ranges::sort(others, {}, &Definition::name);
  const std::string referenced =
      joined(others, [&](const Definition& other) { return json_of(other); });
  return "RIHS01_" + sha256("{\"type_description\": " + json_of(definitions.front()) +
                            ", \"referenced_type_descriptions\": [" + referenced + "]}");
}

}  // namespace pedicel::ros
