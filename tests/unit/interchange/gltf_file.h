#pragma once

#include <catch2/catch.hpp>
#include <cstring>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace farol::test {

/// A binary glTF file, read by the specification and not by the writer's code.
struct GltfFile {
    explicit GltfFile(const std::string& file) {
        const auto number = [&](std::size_t at) {
            std::uint32_t value = 0;
            std::memcpy(&value, file.data() + at, 4);
            return std::size_t{value};
        };
        REQUIRE(file.size() >= 20);
        REQUIRE(file.substr(0, 4) == "glTF");
        REQUIRE(number(4) == 2);
        REQUIRE(number(8) == file.size());
        const std::size_t length = number(12);
        REQUIRE(file.substr(16, 4) == "JSON");
        REQUIRE(length % 4 == 0);
        json = nlohmann::json::parse(file.substr(20, length));
        if (20 + length == file.size()) return;
        REQUIRE(number(20 + length) % 4 == 0);
        REQUIRE(file.substr(24 + length, 4) == std::string("BIN\0", 4));
        bytes = file.substr(28 + length);
    }

    /// The floats of an accessor.
    std::vector<float> floats(int accessor) const {
        const nlohmann::json& one = json["accessors"].at(static_cast<std::size_t>(accessor));
        REQUIRE(one["componentType"] == 5126);
        const std::string type = one["type"];
        const std::size_t components = type == "SCALAR" ? 1
                                       : type == "VEC2" ? 2
                                       : type == "VEC3" ? 3
                                                        : 4;
        std::vector<float> values(one["count"].get<std::size_t>() * components);
        const nlohmann::json& view = json["bufferViews"].at(one["bufferView"].get<std::size_t>());
        const std::size_t begin =
            view["byteOffset"].get<std::size_t>() + one.value("byteOffset", std::size_t{0});
        REQUIRE(begin + values.size() * 4 <= bytes.size());
        std::memcpy(values.data(), bytes.data() + begin, values.size() * 4);
        return values;
    }

    const nlohmann::json* find(const char* list, const std::string& name) const {
        for (const nlohmann::json& one : json[list])
            if (one.value("name", "") == name) return &one;
        return nullptr;
    }

    /// parentFromNode at a time: animated parts interpolated linearly, rotations spherically.
    glm::dmat4 matrixAt(std::size_t node, double timeS) const {
        const nlohmann::json& one = json["nodes"].at(node);
        const auto list = [&](const char* key, std::vector<double> fallback) {
            return one.value(key, std::move(fallback));
        };
        std::vector<double> t = list("translation", {0, 0, 0}), r = list("rotation", {0, 0, 0, 1});
        const std::vector<double> s = list("scale", {1, 1, 1});
        if (json.contains("animations"))
            for (const nlohmann::json& channel : json["animations"][0]["channels"]) {
                if (channel["target"]["node"] != node) continue;
                (channel["target"]["path"] == "translation" ? t : r) =
                    valueAt(channel["sampler"], timeS);
            }
        const glm::dmat4 moved = glm::translate(glm::dmat4(1.0), glm::dvec3(t[0], t[1], t[2]));
        const glm::dmat4 turned(glm::mat4_cast(glm::normalize(glm::dquat(r[3], r[0], r[1], r[2]))));
        return glm::scale(moved * turned, glm::dvec3(s[0], s[1], s[2]));
    }

    nlohmann::json json;
    std::string bytes;

  private:
    std::vector<double> valueAt(std::size_t sampler, double timeS) const {
        const nlohmann::json& one = json["animations"][0]["samplers"].at(sampler);
        REQUIRE(one["interpolation"] == "LINEAR");
        const std::vector<float> times = floats(one["input"]), values = floats(one["output"]);
        const std::size_t width = values.size() / times.size();
        std::size_t next = 1;
        while (next + 1 < times.size() && double{times[next]} < timeS) ++next;
        const double span = double{times[next]} - double{times[next - 1]};
        const double share = std::clamp((timeS - double{times[next - 1]}) / span, 0.0, 1.0);
        const float* a = &values[(next - 1) * width];
        const float* b = &values[next * width];
        if (width == 4) {
            const glm::dquat q = glm::slerp(glm::dquat(a[3], a[0], a[1], a[2]),
                                            glm::dquat(b[3], b[0], b[1], b[2]), share);
            return {q.x, q.y, q.z, q.w};
        }
        std::vector<double> out;
        for (std::size_t k = 0; k < width; ++k)
            out.push_back(glm::mix(double{a[k]}, double{b[k]}, share));
        return out;
    }
};

}  // namespace farol::test
