#include "engine/cluster/case_record.h"

#include <nlohmann/json.hpp>

namespace pedicel::cluster {

std::string to_json(const CaseRecord& r) {
  return nlohmann::ordered_json{{"id", r.id},
                                {"name", r.name},
                                {"version", r.program.version},
                                {"git_hash", r.program.git_hash},
                                {"build", r.program.build},
                                {"instruction_set", r.instruction_set},
                                {"math", r.math},
                                {"host", r.host},
                                {"job", r.job},
                                {"SLURM_RESTART_COUNT", r.restarts},
                                {"exit_code", r.exit_code},
                                {"wall_s", r.seconds},
                                {"ended", r.ended},
                                {"reason", r.reason}}
      .dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

CaseRecord parse_record(const std::string& text, const std::string& file) {
  try {
    const auto json = nlohmann::json::parse(text);
    CaseRecord r;
    json.at("id").get_to(r.id);
    json.at("name").get_to(r.name);
    json.at("version").get_to(r.program.version);
    json.at("git_hash").get_to(r.program.git_hash);
    json.at("build").get_to(r.program.build);
    json.at("instruction_set").get_to(r.instruction_set);
    json.at("math").get_to(r.math);
    json.at("host").get_to(r.host);
    json.at("job").get_to(r.job);
    json.at("SLURM_RESTART_COUNT").get_to(r.restarts);
    json.at("exit_code").get_to(r.exit_code);
    json.at("wall_s").get_to(r.seconds);
    json.at("ended").get_to(r.ended);
    json.at("reason").get_to(r.reason);
    return r;
  } catch (const nlohmann::json::exception& fault) {
    throw InvalidFile({file}, std::string("is no record of a case: ") + fault.what());
  }
}

}  // namespace pedicel::cluster
