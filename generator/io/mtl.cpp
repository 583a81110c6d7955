#include "generator/io/mtl.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "core/text.h"
#include "generator/io/plain_text.h"
#include "generator/io/rows.h"
#include "generator/messages.h"

namespace farol::generator::io {
namespace {

constexpr std::size_t kMaxLibraries = 16;
constexpr std::size_t kMaxMaterials = 4096;
constexpr std::size_t kMaxNameBytes = 256;
constexpr float kMaxShininess = 10'000.0F;

bool isBlankChar(char c) { return c == ' ' || c == '\t' || c == '\r'; }

std::string_view trimBlanks(std::string_view text) {
    while (!text.empty() && isBlankChar(text.front())) text.remove_prefix(1);
    while (!text.empty() && isBlankChar(text.back())) text.remove_suffix(1);
    return text;
}

std::string_view wordOf(std::string_view& line) {
    line = trimBlanks(line);
    std::size_t end = 0;
    while (end < line.size() && !isBlankChar(line[end])) ++end;
    const std::string_view word = line.substr(0, end);
    line.remove_prefix(end);
    return word;
}

class MtlReader {
  public:
    MtlReader(const std::string& file, Diagnostics& findings) : file_(file), findings_(findings) {}

    void readLine(std::string_view line) {
        ++line_;
        line = trimBlanks(line);
        if (line.empty() || line[0] == '#') return;
        const std::string keyword = lowerCase(wordOf(line).substr(0, 32));
        line = trimBlanks(line);
        if (keyword == "newmtl") return begin(line);
        if (materials_.empty()) {
            ++leftOut_["lines before the first material"];
            return;
        }
        scene::PartMaterial& part = materials_.back();
        if (keyword == "kd")
            part.material.diffuse.rgb = color(line, part.material.diffuse.rgb);
        else if (keyword == "ks")
            part.material.specular.rgb = color(line, part.material.specular.rgb);
        else if (keyword == "ke")
            part.material.emissive.rgb = color(line, part.material.emissive.rgb);
        else if (keyword == "ns")
            part.material.shininess = static_cast<float>(number(line).value_or(0.0));
        else if (keyword == "illum")
            isDull_ = number(line).value_or(2.0) < 2.0;
        else if (keyword == "d" || keyword == "tr")
            readOpacity(keyword, line, part.material);
        else if (keyword == "map_kd")
            readTexture(line, part);
        else if (keyword != "ka" && keyword != "ni" && keyword != "tf" && keyword != "map_ka")
            ++leftOut_[keyword.rfind("map_", 0) == 0 || keyword == "bump" || keyword == "norm"
                           ? "maps that are not drawn"
                           : "lines with keywords that are not read"];
    }

    std::vector<scene::PartMaterial> take() {
        close();
        if (!leftOut_.empty()) {
            std::string list;
            for (const auto& [what, count] : leftOut_)
                list += (list.empty() ? "" : ", ") + std::to_string(count) + " " + what;
            findings_.push_back(
                diagnosticOf(Severity::info,
                             message<"mesh.left-out">("file"_arg = file_, "list"_arg = uncut(list)),
                             {file_, 0, 0}));
        }
        return std::move(materials_);
    }

  private:
    void begin(std::string_view name) {
        close();
        if (materials_.size() == kMaxMaterials) {
            ++leftOut_["materials after the first " + std::to_string(kMaxMaterials)];
            return;
        }
        isDull_ = false;
        materials_.emplace_back().name = std::string(name.substr(0, kMaxNameBytes));
    }

    /// Computes the values that depend on several lines of a material.
    void close() {
        if (materials_.empty()) return;
        scene::PartMaterial& part = materials_.back();
        scene::Material& material = part.material;
        if (isDull_) material.specular.rgb = glm::vec3(0.0F);
        // Exporters write a black Kd where the texture gives the whole colour.
        if (part.texture && material.diffuse.rgb == glm::vec3(0.0F))
            material.diffuse.rgb = glm::vec3(1.0F);
        material.ambient.rgb = 0.25F * material.diffuse.rgb;
        material.shininess = std::clamp(material.shininess, 0.0F, kMaxShininess);
    }

    std::optional<double> number(std::string_view& line) const {
        std::string_view rest = line;
        const std::string_view word = wordOf(rest);
        if (word.empty()) return std::nullopt;
        try {
            const std::optional<double> value = numberOf(word, {});
            if (!value || !std::isfinite(*value)) return std::nullopt;
            line = rest;
            return value;
        } catch (const Error&) {  // beyond all bounds
            return std::nullopt;
        }
    }

    /// One number is grey; "spectral" and "xyz" are forms that no exporter of the field writes.
    glm::vec3 color(std::string_view line, const glm::vec3& fallback) {
        const auto r = number(line);
        if (!r) {
            ++leftOut_["colours that are no numbers"];
            return fallback;
        }
        const auto g = number(line), b = number(line);
        const glm::dvec3 rgb(*r, g.value_or(*r), b.value_or(*r));
        return glm::vec3(glm::clamp(rgb, 0.0, 1.0));
    }

    void readOpacity(const std::string& keyword, std::string_view line, scene::Material& material) {
        if (line.rfind("-halo", 0) == 0) wordOf(line);
        const auto value = number(line);
        if (!value) return;
        const double opacity = keyword == "d" ? *value : 1.0 - *value;
        // Some exporters write "Tr 1" and mean opaque; a material that cannot be seen is none.
        if (opacity > 0.0 && opacity < 1.0) material.opacity = static_cast<float>(opacity);
    }

    void readTexture(std::string_view line, scene::PartMaterial& part) {
        scene::Texture texture;
        texture.where.file = file_;
        texture.where.line = line_;
        texture.where.column = 1;
        while (!line.empty() && line[0] == '-') {
            std::string_view rest = line;
            const std::string option = lowerCase(wordOf(rest).substr(0, 16));
            if (option == "-s" || option == "-o" || option == "-t") {
                glm::dvec2 value(option == "-s" ? 1.0 : 0.0);
                std::optional<double> one;
                for (int k = 0; k < 3 && (one = number(rest)); ++k)
                    if (k < 2) value[k] = *one;
                if (option == "-s") texture.scale = value;
                if (option == "-o") texture.offset = value;
                if (option == "-t") ++leftOut_["turbulences of maps"];
            } else if (option == "-clamp") {
                texture.clamp = sameWord(wordOf(rest), "on");
            } else if (option == "-mm") {
                number(rest);
                number(rest);
            } else if (option == "-bm" || option == "-boost" || option == "-texres" ||
                       option == "-blendu" || option == "-blendv" || option == "-cc" ||
                       option == "-imfchan" || option == "-type") {
                wordOf(rest);
            } else {
                break;  // the name itself begins with a dash
            }
            line = trimBlanks(rest);
        }
        if (line.size() > 1 && line.front() == '"' && line.back() == '"')
            line = line.substr(1, line.size() - 2);
        if (line.empty()) return;
        texture.file = std::string(line.substr(0, 4 * kMaxNameBytes));
        std::replace(texture.file.begin(), texture.file.end(), '\\', '/');
        part.texture = std::move(texture);
    }

    const std::string& file_;
    Diagnostics& findings_;
    int line_ = 0;
    bool isDull_ = false;  ///< without highlights
    std::vector<scene::PartMaterial> materials_;
    std::map<std::string, std::size_t> leftOut_;
};

}  // namespace

std::vector<std::string> materialLibraries(std::string_view obj) {
    constexpr std::string_view kKeyword = "mtllib";
    std::vector<std::string> names;
    for (std::size_t at = obj.find(kKeyword); at != std::string_view::npos;
         at = obj.find(kKeyword, at + 1)) {
        std::size_t before = at;  // blanks alone may stand before it
        while (before > 0 && isBlankChar(obj[before - 1]) && obj[before - 1] != '\r') --before;
        const bool first = before == 0 || obj[before - 1] == '\n' || obj[before - 1] == '\r' ||
                           static_cast<unsigned char>(obj[before - 1]) == 0xBF;  // of a mark
        if (!first) continue;
        std::string_view rest = obj.substr(at + kKeyword.size());
        rest = rest.substr(0, rest.find_first_of("\r\n"));
        if (rest.empty() || !isBlankChar(rest[0])) continue;
        rest = trimBlanks(rest);
        if (rest.size() > 1 && rest.front() == '"' && rest.back() == '"')
            rest = rest.substr(1, rest.size() - 2);
        std::string name(rest.substr(0, 4 * kMaxNameBytes));
        std::replace(name.begin(), name.end(), '\\', '/');
        if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end())
            names.push_back(std::move(name));
        if (names.size() == kMaxLibraries) break;
    }
    return names;
}

std::vector<scene::PartMaterial> parseMtl(std::string_view bytes, const std::string& fileName,
                                          Diagnostics& findings) {
    std::string storage;
    std::string_view text = plainText(bytes, storage);
    MtlReader reader(fileName, findings);
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        reader.readLine(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return reader.take();
}

}  // namespace farol::generator::io
