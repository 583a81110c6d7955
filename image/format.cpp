#include "image/format.h"

#include <algorithm>
#include <vector>

#include "core/text.h"

namespace farol::image {

std::string encode(const Image& image, Format format, int quality) {
    return specOf(format).encode(image, quality);
}

std::string contentType(Format format) { return std::string(specOf(format).mime); }

bool hasSignature(std::string_view bytes, Format format) {
    return matches(bytes, specOf(format).signature);
}

bool matches(std::string_view bytes, std::string_view signature) {
    return bytes.size() >= signature.size() &&
           std::equal(signature.begin(), signature.end(), bytes.begin(),
                      [](char wanted, char byte) { return wanted == '?' || wanted == byte; });
}

std::string listFormats(std::string_view FormatSpec::*column, std::string_view separator,
                        std::string_view lastSeparator, std::string_view prefix) {
    std::vector<std::string_view> words;
    for (const FormatSpec& format : kFormats)
        for (const std::string_view word : split(format.*column)) words.push_back(word);
    std::string list;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (i > 0) list += i + 1 < words.size() ? separator : lastSeparator;
        list.append(prefix).append(words[i]);
    }
    return list;
}

}  // namespace farol::image
