#pragma once

#include <charconv>
#include <initializer_list>
#include <string>

#include "generator/mesh.h"

namespace farol::generator::io {

/// Text with numbers in their shortest form that reads back equal, in any locale.
class Writer {
  public:
    void text(std::string_view words) { out_ += words; }

    template <class Number>
    void number(Number value) {
        char digits[40];
        out_.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
    }

    /// Numbers parted by blanks, after an optional keyword, as a line.
    void row(std::initializer_list<float> values, std::string_view keyword = {}) {
        out_ += keyword;
        bool first = keyword.empty();
        for (const float value : values) {
            if (!first) out_ += ' ';
            number(value);
            first = false;
        }
        out_ += '\n';
    }

    /// The place of a vertex, parted by blanks: as floats where the mesh has no origin.
    void place(const Mesh& mesh, std::size_t vertex) {
        const glm::dvec3 far = mesh.place(vertex);
        for (int k = 0; k < 3; ++k) {
            if (k > 0) out_ += ' ';
            if (mesh.origin() == glm::dvec3(0.0))
                number(mesh.positions()[vertex][k]);
            else
                number(far[k]);
        }
    }

    std::string take() { return std::move(out_); }

  private:
    std::string out_;
};

}  // namespace farol::generator::io
