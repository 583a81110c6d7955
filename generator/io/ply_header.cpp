#include "generator/io/ply_header.h"

#include <algorithm>
#include <array>

#include "core/error.h"
#include "core/number.h"
#include "core/text.h"
#include "generator/mesh.h"
#include "generator/messages.h"

namespace farol::generator::io {
namespace {

std::vector<std::string> wordsOf(std::string_view line) {
    std::vector<std::string> words;
    while (words.size() < 8) {
        const std::size_t begin = line.find_first_not_of(" \t\r");
        if (begin == std::string_view::npos) break;
        const std::size_t end = std::min(line.find_first_of(" \t\r", begin), line.size());
        words.emplace_back(line.substr(begin, end - begin));
        line.remove_prefix(end);
    }
    return words;
}

class HeaderReader {
  public:
    HeaderReader(std::string_view bytes, const std::string& file) : bytes_(bytes), file_(file) {}

    PlyHeader read() {
        std::size_t at = 0;
        bool ended = false, formatted = false;
        while (!ended) {
            const std::size_t end = bytes_.find('\n', at);
            ++header_.lines;
            if (end == std::string_view::npos) fail(message<"mesh.truncated/ply-header">());
            const auto words = wordsOf(bytes_.substr(at, end - at));
            at = end + 1;
            if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
            if (words[0] == "end_header")
                ended = true;
            else if (words[0] == "format")
                formatted = readFormat(words);
            else if (words[0] == "element")
                readElement(words);
            else if (words[0] == "property")
                readProperty(words);
            else if (header_.lines > 1)
                fail(message<"mesh.syntax/ply-line">("value"_arg = words[0]));
        }
        // Home-made files without a format line are text.
        if (!formatted && bytes_.find('\0') != std::string_view::npos)
            fail(message<"mesh.syntax/ply-format">());
        header_.bytes = at;
        checkElementCounts();
        return header_;
    }

  private:
    [[noreturn]] void fail(Message message) const {
        throw Error(std::move(message), {file_, header_.lines, 1});
    }

    bool readFormat(const std::vector<std::string>& words) {
        const std::string kind = words.size() > 1 ? words[1] : "";
        if (kind == "ascii")
            header_.encoding = PlyEncoding::ascii;
        else if (kind == "binary_little_endian")
            header_.encoding = PlyEncoding::littleEndian;
        else if (kind == "binary_big_endian")
            header_.encoding = PlyEncoding::bigEndian;
        else
            fail(message<"mesh.syntax/ply-encoding">("value"_arg = kind));
        return true;
    }

    void readElement(const std::vector<std::string>& words) {
        constexpr std::size_t kMaxElements = 32;
        const auto count = words.size() == 3 ? parseExact<std::uint64_t>(words[2]) : std::nullopt;
        if (!count) fail(message<"mesh.syntax/ply-element">());
        if (header_.elements.size() == kMaxElements)
            fail(message<"mesh.count/elements">("most"_arg = kMaxElements));
        if (hasName(header_.elements, words[1]))
            fail(message<"mesh.syntax/ply-second-element">("name"_arg = words[1]));
        header_.elements.push_back({words[1], static_cast<std::size_t>(*count), {}, header_.lines});
    }

    void readProperty(const std::vector<std::string>& words) {
        constexpr std::size_t kMaxProperties = 64;
        if (header_.elements.empty()) fail(message<"mesh.syntax/ply-order">());
        auto& properties = header_.elements.back().properties;
        if (properties.size() == kMaxProperties)
            fail(message<"mesh.count/properties">("most"_arg = kMaxProperties));
        const bool list = words.size() == 5 && words[1] == "list";
        if (!list && words.size() != 3) fail(message<"mesh.syntax/ply-property">());
        PlyProperty property;
        property.name = words.back();
        if (hasName(properties, property.name))
            fail(message<"mesh.syntax/ply-second-property">("name"_arg = property.name));
        property.list = list;
        property.type = typeOf(words[list ? 3 : 1]);
        if (list) property.lengthType = typeOf(words[2]);
        if (list && property.lengthType >= PlyType::float32)
            fail(message<"mesh.syntax/ply-length">("value"_arg = words[2]));
        properties.push_back(property);
    }

    template <class Named>
    static bool hasName(const std::vector<Named>& list, const std::string& name) {
        return std::any_of(list.begin(), list.end(),
                           [&name](const Named& other) { return other.name == name; });
    }

    PlyType typeOf(const std::string& name) const {
        static const std::array<std::array<const char*, 2>, 8> kNames{{{"char", "int8"},
                                                                       {"uchar", "uint8"},
                                                                       {"short", "int16"},
                                                                       {"ushort", "uint16"},
                                                                       {"int", "int32"},
                                                                       {"uint", "uint32"},
                                                                       {"float", "float32"},
                                                                       {"double", "float64"}}};
        for (std::size_t i = 0; i < kNames.size(); ++i)
            if (name == kNames[i][0] || name == kNames[i][1]) return static_cast<PlyType>(i);
        fail(message<"mesh.syntax/ply-type">("value"_arg = name));
    }

    void checkElementCounts() const {
        const std::size_t left = bytes_.size() - header_.bytes;
        for (const PlyElement& element : header_.elements) {
            const std::size_t least = element.leastBytes(header_.encoding);
            // The last ascii line may lack its line feed.
            if (least > 0 && element.count > (left + 1) / least)
                fail(message<"mesh.count/held">("count"_arg = element.count,
                                                "element"_arg = element.name));
            if (least == 0 && element.count > left)
                fail(message<"mesh.count/huge">("count"_arg = element.count,
                                                "element"_arg = element.name, "most"_arg = left));
            if (element.name == "vertex") checkCounts(element.count, 0, file_);
        }
    }

    std::string_view bytes_;
    const std::string& file_;
    PlyHeader header_;
};

}  // namespace

std::size_t plySize(PlyType type) {
    static constexpr std::array<std::size_t, 8> kSizes{1, 1, 2, 2, 4, 4, 4, 8};
    return kSizes[static_cast<std::size_t>(type)];
}

std::size_t PlyElement::leastBytes(PlyEncoding encoding) const {
    if (encoding == PlyEncoding::ascii) return 2 * properties.size();  // a digit and a separator
    std::size_t bytes = 0;
    for (const PlyProperty& one : properties)
        bytes += plySize(one.list ? one.lengthType : one.type);
    return bytes;
}

PlyHeader parsePlyHeader(std::string_view bytes, const std::string& fileName) {
    return HeaderReader(bytes, fileName).read();
}

}  // namespace farol::generator::io
