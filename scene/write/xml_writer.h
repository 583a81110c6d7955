#pragma once

#include <glm/glm.hpp>
#include <string>
#include <string_view>

#include "core/number.h"

namespace farol::scene {

/// Returns text with the characters that XML reserves as entities.
std::string escaped(std::string_view text);

/// Builds indented XML. `open` and `leaf` begin a tag, attributes follow, `children` or `end`
/// close it.
class XmlWriter {
  public:
    std::string take() { return std::move(out_); }

    void begin(std::string_view name) {
        indent();
        out_ += "<";
        out_ += name;
    }
    void text(std::string_view name, std::string_view value) {
        out_ += " ";
        out_ += name;
        out_ += "=\"" + escaped(value) + "\"";
    }
    void optionalText(std::string_view name, std::string_view value) {
        if (!value.empty()) text(name, value);
    }
    void number(std::string_view name, double value) { text(name, formatNumber(value)); }
    void vector(std::string_view prefix, std::string_view axes, const glm::dvec3& v) {
        for (int i = 0; i < 3; ++i)
            number(std::string(prefix) + axes[static_cast<std::size_t>(i)], v[i]);
    }
    void leaf() { out_ += "/>\n"; }
    void content() {
        out_ += ">\n";
        ++depth_;
    }
    void close(std::string_view name) {
        --depth_;
        indent();
        out_ += "</";
        out_ += name;
        out_ += ">\n";
    }
    void element(std::string_view name, std::string_view value) {
        begin(name);
        out_ += ">" + escaped(value) + "</";
        out_ += name;
        out_ += ">\n";
    }
    void comment(const std::string& words) {
        if (words.find("--") != std::string::npos) return;  // no comment can hold it
        indent();
        out_ += "<!-- " + words + " -->\n";
    }

  private:
    void indent() { out_.append(static_cast<std::size_t>(2 * depth_), ' '); }
    std::string out_;
    int depth_ = 0;
};

}  // namespace farol::scene
