#include "interchange/gltf/document.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "core/digest.h"
#include "core/error.h"
#include "interchange/messages.h"

namespace farol::interchange {
namespace {

using nlohmann::json;

static_assert(std::endian::native == std::endian::little, "glTF stores little-endian numbers");

constexpr int kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;
constexpr std::size_t kHeadBytes = 12 + 8 + 8;

void append32(std::string& out, std::size_t value) {
    const auto number = static_cast<std::uint32_t>(value);
    out.append(reinterpret_cast<const char*>(&number), sizeof number);
}

std::size_t padded(std::size_t size) { return (size + 3) / 4 * 4; }

template <typename T>
std::string_view bytesOf(std::span<const T> values) {
    return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

}  // namespace

json toJson(const glm::dvec3& vector) { return json::array({vector.x, vector.y, vector.z}); }
json toJson(const glm::vec3& vector) { return json::array({vector.x, vector.y, vector.z}); }
json toJson(const glm::dquat& q) { return json::array({q.x, q.y, q.z, q.w}); }

int GltfDocument::add(std::string_view list, json value) {
    json& values = root_[std::string(list)];
    values.push_back(std::move(value));
    if (list == "nodes" && values.size() > kMaxNodes)
        throw Error(message<"limit.model/nodes">("max"_arg = kMaxNodes));
    return static_cast<int>(values.size()) - 1;
}

int GltfDocument::addOnce(std::string_view list, const json& value) {
    const auto [at, isNew] = once_.emplace(
        std::string(list) + value.dump(-1, ' ', false, json::error_handler_t::replace), 0);
    if (isNew) at->second = add(list, value);
    return at->second;
}

void GltfDocument::use(std::string_view extension) {
    addOnce("extensionsUsed", std::string(extension));
}

std::size_t GltfDocument::count(std::string_view list) const {
    const auto found = root_.find(std::string(list));
    return found == root_.end() ? 0 : found->size();
}

void GltfDocument::checkSize(std::size_t more) const {
    if (bytes_.size() + more > maxBytes_)
        throw Error(message<"limit.model/bytes">("max"_arg = maxBytes_ >> 20U));
}

int GltfDocument::addView(std::string_view bytes, Target target) {
    checkSize(bytes.size() + 4);
    bytes_.resize(padded(bytes_.size()), '\0');
    json view{{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", bytes.size()}};
    if (target != Target::none) view["target"] = static_cast<int>(target);
    bytes_ += bytes;
    return add("bufferViews", std::move(view));
}

/// `boundsOf`: components of a value whose bounds are written; 0: none.
template <typename T>
int GltfDocument::addAccessor(std::span<const T> values, const Layout& layout, Target target,
                              int boundsOf) {
    const std::string_view bytes = bytesOf(values);
    std::string key = std::string("accessor") + std::string(layout.type) +
                      std::to_string(static_cast<int>(target)) + ' ';
    key += contentDigest(bytes);
    const auto [at, isNew] = once_.emplace(std::move(key), 0);
    if (!isNew) return at->second;
    json accessor{{"bufferView", addView(bytes, target)},
                  {"componentType", layout.componentType},
                  {"type", layout.type},
                  {"count", values.size()}};
    if (layout.isNormalized) accessor["normalized"] = true;
    for (int k = 0; k < boundsOf; ++k) {
        float low = 0.0F, high = 0.0F;
        for (std::size_t i = 0; i < values.size(); ++i) {
            float value = 0.0F;
            std::memcpy(&value, bytes.data() + i * sizeof(T) + static_cast<std::size_t>(k) * 4, 4);
            low = i == 0 ? value : std::min(low, value);
            high = i == 0 ? value : std::max(high, value);
        }
        accessor["min"].push_back(low);
        accessor["max"].push_back(high);
    }
    return at->second = add("accessors", std::move(accessor));
}

int GltfDocument::addPositions(std::span<const glm::vec3> values) {
    return addAccessor(values, {kFloat, "VEC3"}, Target::vertices, 3);
}

int GltfDocument::addNormals(std::span<const glm::vec3> values) {
    // Mesh files may have normals without a length.
    std::vector<glm::vec3> units(values.begin(), values.end());
    for (glm::vec3& normal : units) {
        const float length = glm::length(normal);
        normal = length > 0.0F ? normal / length : glm::vec3(0.0F, 1.0F, 0.0F);
    }
    return addAccessor(std::span<const glm::vec3>(units), {kFloat, "VEC3"}, Target::vertices);
}

int GltfDocument::addUvs(std::span<const glm::vec2> values) {
    return addAccessor(values, {kFloat, "VEC2"}, Target::vertices);
}

int GltfDocument::addColors(std::span<const glm::vec3> values) {
    constexpr float kFull = 65535.0F;
    std::vector<glm::u16vec4> shorts;
    shorts.reserve(values.size());
    for (const glm::vec3& color : values)
        shorts.emplace_back(glm::u16vec3(glm::clamp(color, 0.0F, 1.0F) * kFull + 0.5F), 65535);
    return addAccessor(std::span<const glm::u16vec4>(shorts), {kUnsignedShort, "VEC4", true},
                       Target::vertices);
}

int GltfDocument::addTimes(std::span<const double> values) {
    const std::vector<float> floats(values.begin(), values.end());
    return addAccessor(std::span<const float>(floats), {kFloat, "SCALAR"}, Target::none, 1);
}

int GltfDocument::addTranslations(std::span<const glm::dvec3> values) {
    const std::vector<glm::vec3> floats(values.begin(), values.end());
    return addAccessor(std::span<const glm::vec3>(floats), {kFloat, "VEC3"}, Target::none);
}

int GltfDocument::addRotations(std::span<const glm::dquat> values) {
    std::vector<glm::vec4> floats;
    floats.reserve(values.size());
    for (const glm::dquat& q : values) floats.emplace_back(q.x, q.y, q.z, q.w);
    return addAccessor(std::span<const glm::vec4>(floats), {kFloat, "VEC4"}, Target::none);
}

GltfDocument::IndexView GltfDocument::addIndices(std::span<const std::uint32_t> indices) {
    constexpr std::uint32_t kRestart = 65535;
    const bool isWide = std::any_of(indices.begin(), indices.end(),
                                    [](std::uint32_t index) { return index >= kRestart; });
    if (isWide) return {addView(bytesOf(indices), Target::indices), true};
    const std::vector<std::uint16_t> shorts(indices.begin(), indices.end());
    return {addView(bytesOf(std::span<const std::uint16_t>(shorts)), Target::indices), false};
}

int GltfDocument::addIndexAccessor(const IndexView& view, std::size_t first, std::size_t count) {
    const std::size_t size = view.isWide ? 4 : 2;
    return addOnce("accessors", {{"bufferView", view.view},
                                 {"byteOffset", first * size},
                                 {"componentType", view.isWide ? kUnsignedInt : kUnsignedShort},
                                 {"type", "SCALAR"},
                                 {"count", count}});
}

std::string GltfDocument::take() {
    if (!bytes_.empty()) root_["buffers"] = json::array({{{"byteLength", bytes_.size()}}});
    // Names come from files of any encoding.
    std::string text = root_.dump(-1, ' ', false, json::error_handler_t::replace);
    checkSize(text.size() + kHeadBytes + 8);
    text.resize(padded(text.size()), ' ');
    bytes_.resize(padded(bytes_.size()), '\0');
    std::string out;
    const std::size_t total = kHeadBytes - (bytes_.empty() ? 8 : 0) + text.size() + bytes_.size();
    out.reserve(total);
    out += "glTF";
    append32(out, 2);
    append32(out, total);
    append32(out, text.size());
    out += "JSON";
    out += text;
    if (bytes_.empty()) return out;
    append32(out, bytes_.size());
    out.append("BIN\0", 4);
    out += bytes_;
    return out;
}

}  // namespace farol::interchange
