#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace pedicel::ros {

/// A field of a message as ROS 2 names it.
struct FieldDefinition {
  enum class Count { one, array, sequence };
  std::string name;
  std::string type;  ///< "float64", "string", or a message's name: "std_msgs/msg/Header"
  Count count = Count::one;
  int size = 0;  ///< of an array
  bool operator==(const FieldDefinition&) const = default;
};

/// A message: its name, and its fields in their order.
struct Definition {
  std::string name;  ///< "sensor_msgs/msg/JointState"
  std::vector<FieldDefinition> fields;
};

/// Whether a type is a message and no primitive: it has a slash.
bool is_message(const std::string& type);

/// "float64[9] k": a field as a line of a .msg file, messages without the "/msg".
std::string field_text(const FieldDefinition& field);

/// The text that MCAP's schema encoding `ros2msg` takes: the first definition's fields, and after a
/// line of "=" and "MSG: package/Name" those of each of the others.
std::string schema_text(const std::vector<Definition>& definitions);

/// Repeats `each(x)` for each of up to 27 arguments.
#define PEDICEL_EACH(each, ...) __VA_OPT__(PEDICEL_SCAN(PEDICEL_NEXT(each, __VA_ARGS__)))
#define PEDICEL_NEXT(each, x, ...) each(x) __VA_OPT__(PEDICEL_LATER PEDICEL_NONE(each, __VA_ARGS__))
#define PEDICEL_LATER() PEDICEL_NEXT
#define PEDICEL_NONE ()
#define PEDICEL_SCAN(...) PEDICEL_SCAN9(PEDICEL_SCAN9(PEDICEL_SCAN9(__VA_ARGS__)))
#define PEDICEL_SCAN9(...) PEDICEL_SCAN3(PEDICEL_SCAN3(PEDICEL_SCAN3(__VA_ARGS__)))
#define PEDICEL_SCAN3(...) PEDICEL_SCAN1(PEDICEL_SCAN1(PEDICEL_SCAN1(__VA_ARGS__)))
#define PEDICEL_SCAN1(...) __VA_ARGS__
#define PEDICEL_VISIT(field) visit(#field, self.field);

/// Of a message whose members are called as its fields are: fields() of these, in their order.
#define PEDICEL_FIELDS(...)                      \
  template <class Self, class Visit>             \
  static void fields(Self& self, Visit& visit) { \
    PEDICEL_EACH(PEDICEL_VISIT, __VA_ARGS__)     \
  }

/// A message is a struct with its ROS name and a function that shows its fields to a visitor, in
/// their order; everything else (text, bytes both ways, hash) comes from that:
///   static constexpr const char* name = "std_msgs/msg/Header";
///   PEDICEL_FIELDS(stamp, frame_id)
/// where a member is called otherwise:
///   template <class Self, class Visit> static void fields(Self& self, Visit& visit) {
///     visit("fields", self.point_fields);
///   }
template <class T>
concept Message = requires {
  T::name;
};

template <class T>
struct IsVector : std::false_type {};
template <class T>
struct IsVector<std::vector<T>> : std::true_type {};
template <class T>
struct IsArray : std::false_type {};
template <class T, std::size_t n>
struct IsArray<std::array<T, n>> : std::true_type {};

/// ROS's name of a C++ type that is no message.
template <class T>
constexpr const char* primitive_name() {
  if constexpr (std::is_same_v<T, bool>)
    return "bool";
  else if constexpr (std::is_same_v<T, std::int8_t>)
    return "int8";
  else if constexpr (std::is_same_v<T, std::uint8_t>)
    return "uint8";
  else if constexpr (std::is_same_v<T, std::int16_t>)
    return "int16";
  else if constexpr (std::is_same_v<T, std::uint16_t>)
    return "uint16";
  else if constexpr (std::is_same_v<T, std::int32_t>)
    return "int32";
  else if constexpr (std::is_same_v<T, std::uint32_t>)
    return "uint32";
  else if constexpr (std::is_same_v<T, std::int64_t>)
    return "int64";
  else if constexpr (std::is_same_v<T, std::uint64_t>)
    return "uint64";
  else if constexpr (std::is_same_v<T, float>)
    return "float32";
  else if constexpr (std::is_same_v<T, double>)
    return "float64";
  else {
    static_assert(std::is_same_v<T, std::string>, "no type of ROS 2");
    return "string";
  }
}

namespace detail {

/// Gathers the definitions of a message and of all that it holds.
class DefinitionVisitor {
 public:
  template <Message M>
  void add() {
    for (const Definition& known : all_)
      if (known.name == M::name) return;
    const std::size_t own = all_.size();
    all_.push_back({M::name, {}});
    const std::size_t outer = own_;
    own_ = own;
    M empty;
    M::fields(empty, *this);
    own_ = outer;
  }
  template <class T>
  void operator()(const char* name, T&) {
    if constexpr (IsVector<T>::value) {
      add_field<typename T::value_type>(name, FieldDefinition::Count::sequence, 0);
    } else if constexpr (IsArray<T>::value) {
      add_field<typename T::value_type>(name, FieldDefinition::Count::array,
                                        static_cast<int>(std::tuple_size_v<T>));
    } else {
      add_field<T>(name, FieldDefinition::Count::one, 0);
    }
  }
  std::vector<Definition> take() { return std::move(all_); }

 private:
  template <class T>
  void add_field(const char* name, FieldDefinition::Count count, int size) {
    if constexpr (Message<T>) {
      all_[own_].fields.push_back({name, T::name, count, size});
      add<T>();
    } else {
      all_[own_].fields.push_back({name, primitive_name<T>(), count, size});
    }
  }
  std::vector<Definition> all_;
  std::size_t own_ = 0;
};

}  // namespace detail

/// The message's own definition, then those of all messages in it, each once.
template <Message M>
std::vector<Definition> definitions_of() {
  detail::DefinitionVisitor visitor;
  visitor.add<M>();
  return visitor.take();
}

}  // namespace pedicel::ros
