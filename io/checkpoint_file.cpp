#include "io/checkpoint_file.hpp"

#include <bit>
#include <boost/crc.hpp>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/files.hpp"
#include "io/provenance.hpp"
#include "io/scene_json.hpp"

namespace vlbeam {
namespace {

constexpr std::string_view head = "vlbeam checkpoint 1\n";  // so that one can tell what it is
using Checksum = std::uint32_t;

std::string checksum_of(std::string_view text) {
  boost::crc_32_type crc;
  crc.process_bytes(text.data(), text.size());
  std::string bytes;
  for (Checksum sum = crc.checksum(), i = 0; i < sizeof(Checksum); ++i, sum >>= 8) {
    bytes.push_back(static_cast<char>(sum & 0xff));
  }
  return bytes;
}

/// Numbers as their bytes: a state has thousands.
template <class Vector>
Json packed(const Vector& numbers) {
  static_assert(std::endian::native == std::endian::little);
  std::vector<std::uint8_t> bytes(sizeof(double) * static_cast<std::size_t>(numbers.size()));
  if (!bytes.empty()) std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return Json::binary(std::move(bytes));
}

template <class Vector>
Vector unpacked(const Json& value) {
  const auto& bytes = value.get_binary();
  if (bytes.size() % sizeof(double) != 0) throw std::out_of_range("half a number");
  Vector numbers(static_cast<decltype(Vector().size())>(bytes.size() / sizeof(double)));
  if (!bytes.empty()) std::memcpy(numbers.data(), bytes.data(), bytes.size());
  return numbers;
}

/// What must be the same for the same digits.
Json program() {
  const Json all = provenance();
  Json kept;
  for (const char* key : {"program", "commit", "compiler", "flags"}) kept[key] = all.at(key);
  return kept;
}

/// The first key, as a JSON pointer, whose values differ.
std::string first_difference(const Json& a, const Json& b) { return Json::diff(a, b).at(0).at("path"); }

Checkpoint checkpoint_from(const Json& json) {
  Checkpoint checkpoint;
  for (const Json& entry : json.at("past")) {
    checkpoint.past.push_back({entry.at(0).get<int>(), entry.at(1).get<double>(),
                               unpacked<Eigen::VectorXd>(entry.at(2)), unpacked<std::vector<double>>(entry.at(3))});
  }
  checkpoint.t = json.at("t").get<double>();
  checkpoint.y = unpacked<Eigen::VectorXd>(json.at("y"));
  checkpoint.system = unpacked<std::vector<double>>(json.at("system"));
  checkpoint.method = unpacked<std::vector<double>>(json.at("method"));
  checkpoint.seconds = json.at("seconds").get<double>();
  return checkpoint;
}

}  // namespace

void write_checkpoint(const std::filesystem::path& file, const Scene& scene, const Checkpoint& checkpoint) {
  Json json{{"program", program()}, {"scene", scene_to_json(scene)}};
  Json& past = json["past"] = Json::array();
  for (const LoggedEvent& entry : checkpoint.past) {
    past.push_back({entry.guard, entry.t, packed(entry.y), packed(entry.system)});
  }
  json["t"] = checkpoint.t;
  json["y"] = packed(checkpoint.y);
  json["system"] = packed(checkpoint.system);
  json["method"] = packed(checkpoint.method);
  json["seconds"] = checkpoint.seconds;
  std::string text(head);
  Json::to_cbor(json, text);
  text += checksum_of(text);
  write_text(file, text);
}

Checkpoint read_checkpoint(const std::filesystem::path& file, const Scene& scene) {
  const std::string name = file.string();
  const std::string text = read_text(file);
  if (!text.starts_with(head)) refuse(name, "what stands there", "it must be a checkpoint of this program's");
  const std::string_view body = std::string_view(text).substr(0, text.size() - std::min(text.size(), sizeof(Checksum)));
  if (body.size() < head.size() || text.substr(body.size()) != checksum_of(body)) {
    refuse(name, "a checkpoint that is truncated or damaged", "it must be whole: take an earlier one, or start anew");
  }
  Json json;
  try {
    json = Json::from_cbor(body.substr(head.size()));
    if (json.at("program") != program()) {
      refuse(name, "a checkpoint of another build, " + excerpt(json.at("program")),
             "only that one would go on with the same digits");
    }
    if (const Json own = scene_to_json(scene); json.at("scene") != own) {
      refuse(name, "a checkpoint of another scene", "it differs at " + first_difference(json.at("scene"), own));
    }
    return checkpoint_from(json);
  } catch (const Json::exception&) {
    refuse(name, "a checkpoint that is damaged", "it must be whole: take an earlier one, or start anew");
  } catch (const std::out_of_range&) {
    refuse(name, "a checkpoint that is damaged", "it must be whole: take an earlier one, or start anew");
  }
}

}  // namespace vlbeam
