#include "tools/results/report_record.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <nlohmann/json.hpp>

#include "tools/files/read_text.hpp"
#include "tools/files/sha256.hpp"
#include "tools/results/json_field.hpp"

namespace bladefit {
namespace {

nlohmann::ordered_json identity_json(const ReportIdentity& identity) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const IdentityRow& row : kIdentityRows) json[std::string(row.key)] = identity.*row.text;
  nlohmann::ordered_json fields = nlohmann::ordered_json::array();
  for (const auto& [name, text] : identity.fields) fields.push_back({{"name", name}, {"text", text}});
  json["fields"] = fields;
  return json;
}

ReportIdentity read_identity(const JsonField& json) {
  ReportIdentity identity;
  for (const IdentityRow& row : kIdentityRows) identity.*row.text = json[std::string(row.key).c_str()].text();
  const JsonField fields = json["fields"];
  for (std::size_t k = 0; k < fields.size(); ++k)
    identity.fields.emplace_back(fields.element(k)["name"].text(), fields.element(k)["text"].text());
  return identity;
}

}  // namespace

std::string utc_now() { return fmt::format("{:%Y-%m-%d %H:%M:%S} UTC", fmt::gmtime(std::time(nullptr))); }

ReportFile report_file(const std::string& role, const std::string& path) {
  const std::string content = read_text(path, role);
  return {role, path, content.size(), sha256_of(content)};
}

std::string record_json(const ReportRecord& record) {
  nlohmann::ordered_json files = nlohmann::ordered_json::array();
  for (const ReportFile& file : record.files) {
    files.push_back({{"role", file.role}, {"path", file.path}, {"size", file.size}, {"sha256", file.sha256}});
  }
  nlohmann::ordered_json json;
  json["identity"] = identity_json(record.identity);
  json["begun"] = record.begun;
  json["ended"] = record.ended;
  json["version"] = record.version;
  json["files"] = files;
  // Names of files may be of any bytes.
  return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

ReportRecord parse_record(const std::string& path, const std::string& text) {
  const nlohmann::json json = parse_json(path, text);
  const JsonField root(json, path, "");
  ReportRecord record{
      read_identity(root["identity"]), root["begun"].text(), root["ended"].text(), root["version"].text(), {}};
  const JsonField files = root["files"];
  for (std::size_t k = 0; k < files.size(); ++k) {
    const JsonField file = files.element(k);
    record.files.push_back({file["role"].text(), file["path"].text(), static_cast<std::uint64_t>(file["size"].number()),
                            file["sha256"].text()});
  }
  return record;
}

}  // namespace bladefit
