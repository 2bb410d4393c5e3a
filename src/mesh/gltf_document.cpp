#include "mesh/gltf_document.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <limits>

#include "base/error.hpp"

namespace wold {

static_assert(std::endian::native == std::endian::little, "glTF stores little endian numbers");

namespace {

constexpr std::size_t file_head = 12;
constexpr std::size_t chunk_head = 8;
constexpr std::uint32_t json_type = 0x4e4f534a;
constexpr std::uint32_t bin_type = 0x004e4942;

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof(value));
  return value;
}

void append_word(std::string& bytes, std::uint32_t value) {
  std::array<char, 4> raw{};
  std::memcpy(raw.data(), &value, sizeof(value));
  bytes.append(raw.data(), raw.size());
}

void append_chunk(std::string& bytes, std::uint32_t type, std::string_view data, char padding) {
  const std::size_t padded = (data.size() + 3) / 4 * 4;
  append_word(bytes, static_cast<std::uint32_t>(padded));
  append_word(bytes, type);
  bytes.append(data);
  bytes.append(padded - data.size(), padding);
}

std::string base64(const std::vector<unsigned char>& data) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((data.size() + 2) / 3 * 4);
  for (std::size_t k = 0; k < data.size(); k += 3) {
    std::uint32_t bits = 0;
    for (std::size_t b = 0; b < 3; ++b)
      bits = bits << 8U | (k + b < data.size() ? std::uint32_t{data[k + b]} : 0U);
    for (std::size_t d = 0; d < 4; ++d)
      text += k + d > data.size() ? '=' : digits[bits >> (18 - 6 * d) & 63U];
  }
  return text;
}

std::string_view view_of(const std::vector<unsigned char>& data) {
  return {reinterpret_cast<const char*>(data.data()), data.size()};
}

}  // namespace

GltfDocument::GltfDocument(std::string_view bytes, const GltfModel& model)
    : model_(model), binary_(bytes.starts_with("glTF")) {
  for (const auto& buffer : model->buffers) buffers_.push_back(buffer.data);
  if (binary_)
    read_chunks(bytes);
  else
    json_ = Json::parse(bytes, nullptr, false);
  indented_ = !binary_ && bytes.find('\n') < bytes.find_last_not_of(" \r\n");
  if (json_.is_discarded()) model.fail("its JSON cannot be read");
  check_shape();
}

void GltfDocument::check_shape() const {
  // tinygltf passes over what it cannot use, and counts without it.
  const auto check = [&](const Json& parent, const char* name, std::size_t count) {
    const auto list = parent.find(name);
    if ((list == parent.end() ? 0 : list->size()) != count)
      model_.fail(fmt::format("some of its {} are not usable", name));
  };
  check(json_, "nodes", model_->nodes.size());
  check(json_, "meshes", model_->meshes.size());
  check(json_, "accessors", model_->accessors.size());
  check(json_, "bufferViews", model_->bufferViews.size());
  check(json_, "buffers", model_->buffers.size());
  for (std::size_t k = 0; k < model_->meshes.size(); ++k)
    check(json_["meshes"][k], "primitives", model_->meshes[k].primitives.size());
}

void GltfDocument::read_chunks(std::string_view bytes) {
  std::size_t at = file_head;
  for (bool first = true; at + chunk_head <= bytes.size(); first = false) {
    const std::size_t length = word_at(bytes, at);
    if (length > bytes.size() - at - chunk_head) model_.fail("a chunk reaches beyond its end");
    const std::string_view chunk = bytes.substr(at, chunk_head + length);
    if (first)
      json_ = Json::parse(chunk.substr(chunk_head), nullptr, false);
    else if (word_at(bytes, at + 4) != bin_type)
      other_chunks_.append(chunk);
    at += chunk.size();
  }
}

void GltfDocument::set(int accessor, std::size_t k, const Vec3& value) {
  const auto& a = model_.item(model_->accessors, accessor, "accessor");
  const auto& view = model_.item(model_->bufferViews, a.bufferView, "buffer view");
  // That it is within the buffer was checked when its numbers were read.
  const std::size_t at =
      view.byteOffset + a.byteOffset + k * static_cast<std::size_t>(a.ByteStride(view));
  std::memcpy(buffers_[static_cast<std::size_t>(view.buffer)].data() + at, &value, sizeof(value));
}

int GltfDocument::add(const std::vector<Vec3>& values) {
  std::vector<unsigned char>& data = buffers_.front();
  data.resize((data.size() + 3) / 4 * 4);
  const std::size_t at = data.size();
  const std::size_t size = values.size() * sizeof(Vec3);
  data.resize(at + size);
  if (size > 0) std::memcpy(data.data() + at, values.data(), size);
  json_["bufferViews"].push_back(
      {{"buffer", 0}, {"byteOffset", at}, {"byteLength", size}, {"target", 34962}});
  json_["accessors"].push_back({{"bufferView", json_["bufferViews"].size() - 1},
                                {"componentType", TINYGLTF_COMPONENT_TYPE_FLOAT},
                                {"count", values.size()},
                                {"type", "VEC3"}});
  return static_cast<int>(json_["accessors"].size()) - 1;
}

void GltfDocument::set_bounds(int accessor, const std::vector<Vec3>& values) {
  if (values.empty()) return;
  Vec3 low = values.front();
  Vec3 high = low;
  for (const Vec3& v : values) {
    low = glm::min(low, v);
    high = glm::max(high, v);
  }
  const auto list = [](const Vec3& v) {
    return Json::array(
        {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)});
  };
  json_["accessors"][static_cast<std::size_t>(accessor)]["min"] = list(low);
  json_["accessors"][static_cast<std::size_t>(accessor)]["max"] = list(high);
}

bool GltfDocument::is_binary_chunk(std::size_t buffer) const {
  return binary_ && buffer == 0 && !json_["buffers"][0].contains("uri");
}

std::string GltfDocument::bytes() const {
  Json json = json_;
  for (std::size_t k = 0; k < buffers_.size(); ++k) {
    Json& buffer = json["buffers"][k];
    buffer["byteLength"] = buffers_[k].size();
    if (!is_binary_chunk(k))
      buffer["uri"] = "data:application/octet-stream;base64," + base64(buffers_[k]);
  }
  if (!binary_) return json.dump(indented_ ? 2 : -1) + (indented_ ? "\n" : "");
  std::string chunks;
  append_chunk(chunks, json_type, json.dump(), ' ');
  if (!buffers_.empty() && is_binary_chunk(0)) {
    if (buffers_[0].size() + chunks.size() > std::numeric_limits<std::uint32_t>::max() - 64)
      throw Error(ErrorKind::limit, "a GLB holds at most 4 GB, this mesh needs more; use .gltf");
    append_chunk(chunks, bin_type, view_of(buffers_[0]), '\0');
  }
  chunks += other_chunks_;
  std::string bytes = "glTF";
  append_word(bytes, 2);
  append_word(bytes, static_cast<std::uint32_t>(file_head + chunks.size()));
  return bytes + chunks;
}

}  // namespace wold
