#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// A glTF 2.0 document and its buffer (Khronos, "glTF 2.0 Specification", version 2.0.1).
namespace farol::interchange {

/// More is Error limit.model.
inline constexpr std::size_t kMaxNodes = 250'000;

/// Use of the bytes of a buffer view (glTF 2.0, 5.11.5).
enum class Target { none = 0, vertices = 34962, indices = 34963 };

class GltfDocument {
  public:
    /// `maxBytes`: of the whole file.
    explicit GltfDocument(std::size_t maxBytes) : maxBytes_(maxBytes) {}

    /// Appends to a list of the document ("nodes", "meshes"). Returns the index.
    int add(std::string_view list, nlohmann::json value);
    /// Appends what the list lacks. Returns the index of the equal one.
    int addOnce(std::string_view list, const nlohmann::json& value);
    /// Lists an extension as used.
    void use(std::string_view extension);
    nlohmann::json& root() { return root_; }
    nlohmann::json& at(std::string_view list, int index) {
        return root_[std::string(list)][static_cast<std::size_t>(index)];
    }
    std::size_t count(std::string_view list) const;

    /// Appends bytes at a multiple of four. Returns the buffer view.
    int addView(std::string_view bytes, Target target);
    /// Accessors, equal ones once. Positions and times have the bounds of their values.
    int addPositions(std::span<const glm::vec3> values);
    int addNormals(std::span<const glm::vec3> values);
    int addUvs(std::span<const glm::vec2> values);
    /// Linear colours, as 16 bits.
    int addColors(std::span<const glm::vec3> values);
    int addTimes(std::span<const double> values);
    int addTranslations(std::span<const glm::dvec3> values);
    int addRotations(std::span<const glm::dquat> values);
    /// The view of indices, of 16 bits where all are below 65535.
    struct IndexView {
        int view = 0;
        bool isWide = false;
    };
    IndexView addIndices(std::span<const std::uint32_t> indices);
    /// A part of a view of indices.
    int addIndexAccessor(const IndexView& view, std::size_t first, std::size_t count);

    /// Returns the document as binary glTF (chapter 4.4). Equal documents have equal bytes.
    std::string take();

  private:
    struct Layout {
        int componentType;
        std::string_view type;
        bool isNormalized = false;
    };
    template <typename T>
    int addAccessor(std::span<const T> values, const Layout& layout, Target target,
                    int boundsOf = 0);
    void checkSize(std::size_t more) const;

    const std::size_t maxBytes_;
    nlohmann::json root_ = nlohmann::json::object();
    std::string bytes_;
    std::map<std::string, int> once_;  ///< by list and value
};

/// Numbers of a vector as an array.
nlohmann::json toJson(const glm::dvec3& vector);
nlohmann::json toJson(const glm::vec3& vector);
/// x, y, z, w.
nlohmann::json toJson(const glm::dquat& rotation);

}  // namespace farol::interchange
