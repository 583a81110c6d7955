#include "grade/report/text.h"

#include <cstdio>
#include <span>

#include "core/embedded.h"
#include "core/text.h"
#include "grade/report/page_files.h"

namespace farol {
std::span<const EmbeddedFile> reportFiles();  ///< page.html; page.* and view.* as css and js
}

namespace farol::grade {

std::string twoDigits(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", value);
    return text;
}

std::string forMarkup(const std::string& text) {
    std::string out;
    const std::string valid = toUtf8(text);
    for (std::size_t i = 0; i < valid.size(); ++i) {
        const char c = valid[i];
        const bool isNoCharacter =
            valid.compare(i, 3, "\xEF\xBF\xBE") == 0 || valid.compare(i, 3, "\xEF\xBF\xBF") == 0;
        if (isNoCharacter) {
            i += 2;
            continue;
        }
        switch (c) {
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '&':
                out += "&amp;";
                break;
            case '"':
                out += "&quot;";
                break;
            case '\n':
                out += "&#10;";  // an attribute would make it a blank
                break;
            case '\t':
                out += "&#9;";
                break;
            default:
                if (static_cast<unsigned char>(c) >= 0x20) out += c;
        }
    }
    return out;
}

std::string_view pageFile(std::string_view name) {
    for (const EmbeddedFile& file : reportFiles())
        if (file.name == name) return file.bytes;
    return {};
}

}  // namespace farol::grade
