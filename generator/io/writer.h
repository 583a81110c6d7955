#pragma once

#include <charconv>
#include <initializer_list>
#include <string>

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

    std::string take() { return std::move(out_); }

  private:
    std::string out_;
};

}  // namespace farol::generator::io
