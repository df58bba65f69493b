#include "app/ros/ros_name.h"

#include <cctype>

namespace pedicel::app {

std::string dds_topic(const std::string& ros_topic) {
  return "rt" + ros_topic;
}

std::string dds_request_topic(const std::string& service) {
  return "rq" + service + "Request";
}

std::string dds_reply_topic(const std::string& service) {
  return "rr" + service + "Reply";
}

std::string dds_type(const std::string& ros_type) {
  std::string type;
  std::size_t from = 0;
  for (std::size_t slash = ros_type.find('/'); slash != std::string::npos;
       slash = ros_type.find('/', from)) {
    type += ros_type.substr(from, slash - from) + "::";
    from = slash + 1;
  }
  return type + "dds_::" + ros_type.substr(from) + "_";
}

std::string in_namespace(const std::string& ros_namespace, const std::string& topic) {
  const bool shared = topic == "/clock" || topic == "/tf" || topic == "/tf_static";
  return shared ? topic : ros_namespace + topic;
}

bool is_namespace(const std::string& text) {
  char before = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    if (i == 0 && c != '/') return false;
    if (c != '/' && c != '_' && (c >= 128 || !std::isalnum(c))) return false;
    if (before == '/' && (c == '/' || std::isdigit(c))) return false;
    before = static_cast<char>(c);
  }
  return before != '/';
}

}  // namespace pedicel::app
