#include "tests/fuzz/crafted_meshes.h"

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <string_view>
#include <vector>

namespace farol::fuzz {
namespace {

/// Numbers of one crafted file, and the text made of them.
class Craft {
  public:
    explicit Craft(std::uint64_t number) : random_(number * 0x9E3779B97F4A7C15U + 1) {}

    std::size_t below(std::size_t count) { return random_() % count; }
    bool chance(std::size_t in) { return below(in) == 0; }
    template <std::size_t N>
    const char* oneOf(const std::array<const char*, N>& words) {
        return words[below(N)];
    }
    /// Sizes from one element to some that leave small allocations behind.
    std::size_t size() {
        constexpr std::array<std::size_t, 8> kSizes{1, 2, 3, 5, 40, 400, 4000, 40'000};
        return kSizes[below(kSizes.size())];
    }
    std::string coordinate() {
        if (chance(40))
            return oneOf(std::array{"nan", "-nan", "inf", "-inf", "1e39", "-1e300", "1e-320", "x",
                                    "0x10", "1,5", "", "-", "9e18"});
        return std::to_string(static_cast<int>(below(2000)) - 1000) + ".5";
    }
    std::string index(std::size_t size) {
        if (chance(6))
            return oneOf(std::array{"-1", "0", "4294967295", "4294967296", "-2147483648",
                                    "9223372036854775807", "18446744073709551616", "1.5", "nan",
                                    "1e9", "-0"});
        return std::to_string(chance(6) ? size + below(3) : below(size));
    }
    /// A count that may be far from `count`.
    std::string countNear(std::size_t count) {
        if (chance(2)) return std::to_string(count);
        if (chance(2)) return std::to_string(count + below(5));
        return oneOf(std::array{"0", "-1", "1", "65536", "2147483647", "2147483648", "4294967295",
                                "4294967297", "9223372036854775807", "18446744073709551615",
                                "18446744073709551616", "1e9", "nan", "3.5"});
    }

  private:
    std::mt19937_64 random_;
};

template <class Integer>
void put(std::string& out, Integer value, bool big) {
    for (std::size_t i = 0; i < sizeof(Integer); ++i) {
        const std::size_t at = big ? sizeof(Integer) - 1 - i : i;
        out += static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * at) & 0xFFU);
    }
}

void put(std::string& out, float value, bool big) {
    put(out, std::bit_cast<std::uint32_t>(value), big);
}

void put(std::string& out, double value, bool big) {
    put(out, std::bit_cast<std::uint64_t>(value), big);
}

/// `value` as the named PLY type, whatever becomes of it.
void putTyped(std::string& out, std::string_view type, double value, bool big) {
    const auto whole = static_cast<std::uint64_t>(
        static_cast<std::int64_t>(std::isfinite(value) && std::abs(value) < 9e18 ? value : 0.0));
    if (type == "char" || type == "uchar") put(out, static_cast<std::uint8_t>(whole), big);
    if (type == "short" || type == "ushort") put(out, static_cast<std::uint16_t>(whole), big);
    if (type == "int" || type == "uint") put(out, static_cast<std::uint32_t>(whole), big);
    if (type == "float") put(out, static_cast<float>(value), big);
    if (type == "double") put(out, value, big);
}

constexpr std::array kTypes{"char", "uchar", "short", "ushort", "int", "uint", "float", "double"};
constexpr std::array kFormats{"ascii", "binary_little_endian", "binary_big_endian"};

/// A PLY file, value by value.
class Ply {
  public:
    Ply(Craft& craft, std::string_view format)
        : craft_(craft), ascii_(format == "ascii"), big_(format == "binary_big_endian") {
        head_ = "ply\nformat " + std::string(format) + " 1.0\n";
    }
    void line(const std::string& text) { head_ += text + "\n"; }
    void value(std::string_view type, double value) {
        if (ascii_)
            body_ += std::to_string(value) + " ";
        else
            putTyped(body_, type, value, big_);
    }
    void corner(std::string_view type, double index) {
        if (ascii_)
            body_ += std::to_string(static_cast<long long>(index)) + " ";
        else
            putTyped(body_, type, index, big_);
    }
    void row() {
        if (ascii_) body_ += "\n";
    }
    void vertices(std::size_t count, bool normals, bool uvs) {
        for (std::size_t i = 0; i < count; ++i) {
            for (int k = 0; k < 3; ++k) value("float", double(craft_.below(1000)) / 100);
            for (int k = 0; k < 3 && normals; ++k) value("float", k == 2 ? 1 : 0);
            for (int k = 0; k < 2 && uvs; ++k) value("float", 0.5);
            row();
        }
    }
    std::string take() { return head_ + "end_header\n" + body_; }

  private:
    Craft& craft_;
    bool ascii_, big_;
    std::string head_, body_;
};

const std::string kXyz = "property float x\nproperty float y\nproperty float z";
const std::string kNormal = "property float nx\nproperty float ny\nproperty float nz";
const std::string kUv = "property float u\nproperty float v";
const std::string kFace = "property list uchar int vertex_indices";

/// Two blocks of vertices: positions of both, normals or UVs of one.
std::string plyTwoBlocks(Craft& craft) {
    Ply ply(craft, craft.oneOf(kFormats));
    const std::array sizes{craft.size(), craft.size()};
    const std::size_t all = sizes[0] + sizes[1], dressed = craft.below(3);
    const bool normals = !craft.chance(4), uvs = craft.chance(2);
    for (std::size_t b = 0; b < 2; ++b) {
        ply.line("element vertex " + std::to_string(sizes[b]));
        ply.line(kXyz);
        if (b == dressed && normals) ply.line(kNormal);
        if (b == dressed && uvs) ply.line(kUv);
    }
    ply.line("element face 2");
    ply.line(kFace);
    for (std::size_t b = 0; b < 2; ++b)
        ply.vertices(sizes[b], b == dressed && normals, b == dressed && uvs);
    for (int face = 0; face < 2; ++face) {
        ply.corner("uchar", 3);
        for (std::size_t k = 1; k <= 3; ++k)
            ply.corner("int", double(craft.chance(2) ? all - std::min(all, k) : craft.below(all)));
        ply.row();
    }
    return ply.take();
}

/// Elements and properties that are missing, repeated, in another order or of any type.
std::string plyHeader(Craft& craft) {
    Ply ply(craft, craft.oneOf(kFormats));
    const std::size_t count = 3 + craft.below(4);
    std::vector<std::string> types;
    ply.line("element vertex " + craft.countNear(count));
    constexpr std::array kNames{"x", "y", "z", "nx", "ny", "nz", "u", "v", "s", "t", "x", "red"};
    const std::size_t properties = craft.below(13);
    for (std::size_t k = 0; k < properties; ++k) {
        types.emplace_back(craft.oneOf(kTypes));
        const bool list = craft.chance(8);
        ply.line("property " + std::string(list ? "list uchar " : "") + types.back() + " " +
                 (craft.chance(3) ? craft.oneOf(kNames) : kNames[k % kNames.size()]));
    }
    ply.line("element face " + craft.countNear(1));
    if (!craft.chance(8)) ply.line(kFace);
    if (craft.chance(8)) ply.line("property list uchar int vertex_index");
    if (craft.chance(4))
        ply.line("element " + std::string(craft.chance(2) ? "face" : "edge") + " " +
                 craft.countNear(1));
    for (std::size_t i = 0; i < count; ++i) {
        for (const std::string& type : types)
            ply.value(type, craft.chance(20) ? std::numeric_limits<double>::quiet_NaN()
                                             : double(craft.below(9)));
        ply.row();
    }
    for (int k = 0; k < 4; ++k) ply.corner(k == 0 ? "uchar" : "int", k == 0 ? 3 : k - 1);
    ply.row();
    return ply.take();
}

/// Lists whose lengths and indices are of every type, too long, negative or none.
std::string plyLists(Craft& craft) {
    Ply ply(craft, craft.oneOf(kFormats));
    const std::size_t count = std::max<std::size_t>(3, craft.size());
    const std::string length = craft.oneOf(kTypes), item = craft.oneOf(kTypes);
    ply.line("element vertex " + std::to_string(count));
    ply.line(kXyz);
    ply.line("element face " + craft.countNear(2));
    ply.line("property list " + length + " " + item + " vertex_indices");
    ply.vertices(count, false, false);
    for (int face = 0; face < 2; ++face) {
        constexpr std::array kLengths{3.0,   4.0,     0.0, 2.0, -1.0,         -128.0,
                                      255.0, 65535.0, 2.5, 1e9, 4294967295.0, 1e300};
        const double corners = kLengths[craft.chance(2) ? 0 : craft.below(kLengths.size())];
        ply.value(length, corners);
        for (int k = 0; k < 4; ++k)
            ply.value(item, craft.chance(5) ? double(count) + double(craft.below(3)) - 2
                                            : double(craft.below(3)));
        ply.row();
    }
    return ply.take();
}

std::string withCorners(Craft& craft, std::string head, const std::string& between) {
    const std::size_t corners = craft.size();
    const std::size_t kind = craft.below(4);
    for (std::size_t i = 0; i < corners; ++i) {
        const std::string at = std::to_string(i);
        head += between;
        if (kind == 0) head += i + 1 == corners ? "0 1 0\n" : at + " 0 0\n";
        if (kind == 1) head += at + " " + std::to_string(i * 37 % 101) + " 0\n";
        if (kind == 2) head += at + " " + std::to_string(i % 2) + " 0\n";
        if (kind == 3)
            head += i % 3 == 0 ? "0 0 0\n" : at + " " + std::to_string(i * i % 97) + " 1\n";
    }
    return head;
}

/// One face of many corners.
std::string plyPolygon(Craft& craft) {
    const std::string rows = withCorners(craft, "", "");
    std::size_t corners = 0;
    for (const char c : rows) corners += c == '\n' ? 1 : 0;
    std::string out = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(corners) + "\n" +
                      kXyz +
                      "\nelement face 1\nproperty list int int vertex_indices\nend_header\n" +
                      rows + craft.countNear(corners);
    for (std::size_t i = 0; i < corners; ++i) out += " " + std::to_string(i);
    return out + "\n";
}

std::string obj(Craft& craft) {
    const std::size_t count = std::min<std::size_t>(3 + craft.size(), 400);
    std::string out;
    for (std::size_t i = 0; i < count; ++i) {
        out +=
            "v " + craft.coordinate() + " " + craft.coordinate() + " " + craft.coordinate() + "\n";
        if (craft.chance(2)) out += "vt " + craft.coordinate() + "\n";
        if (craft.chance(3)) out += "vn 0 " + craft.coordinate() + " 1\n";
    }
    for (int face = 0; face < 4; ++face) {
        out += "f";
        const std::size_t corners = craft.chance(8) ? craft.size() : 3 + craft.below(3);
        for (std::size_t k = 0; k < corners; ++k) {
            out +=
                " " + (craft.chance(9) ? craft.index(count + 1) : "-" + std::to_string(1 + k % 3));
            if (craft.chance(3)) out += "/" + (craft.chance(2) ? craft.index(count / 2 + 1) : "");
            if (craft.chance(3)) out += "/" + craft.index(count / 3 + 1);
        }
        out += craft.chance(9) ? " \\\n" : "\n";
    }
    return out;
}

std::string objPolygon(Craft& craft) {
    std::string out = withCorners(craft, "", "v ") + "f";
    const std::size_t corners = craft.size();
    for (std::size_t k = 1; k <= corners; ++k) out += " " + std::to_string(k);
    return out + "\n";
}

std::string stl(Craft& craft) {
    if (craft.chance(3)) {
        std::string out = "solid x\nfacet normal 0 0 1\n";
        const std::size_t count = craft.below(8);
        for (std::size_t k = 0; k < count; ++k)
            out += "vertex " + craft.coordinate() + " " + craft.coordinate() + " 0\n";
        return out + "endsolid\n";
    }
    const std::size_t triangles = craft.below(5);
    std::string out(80, ' ');
    put(out, static_cast<std::uint32_t>(craft.chance(2) ? triangles : craft.below(9) << 29U),
        false);
    for (std::size_t k = 0; k < 12 * triangles; ++k) {
        put(out, craft.chance(30) ? std::numeric_limits<float>::infinity() : float(k % 7), false);
        if (k % 12 == 11) out += std::string(2, '\0');
    }
    return out;
}

std::string off(Craft& craft) {
    const std::size_t count = 3 + craft.below(40), faces = 1 + craft.below(4);
    std::string out = "OFF\n" + craft.countNear(count) + " " + craft.countNear(faces) + " 0\n";
    for (std::size_t i = 0; i < count; ++i)
        out += craft.coordinate() + " " + craft.coordinate() + " " + craft.coordinate() + "\n";
    for (std::size_t f = 0; f < faces; ++f) {
        const std::size_t corners = 3 + craft.below(5);
        out += craft.countNear(corners);
        for (std::size_t k = 0; k < corners; ++k) out += " " + craft.index(count);
        out += "\n";
    }
    return out;
}

/// The text forms with lists: each list may have another length than it should.
std::string text3d(Craft& craft) {
    const std::size_t count = 3 + craft.below(6);
    const auto near = [&craft, count] { return craft.chance(4) ? craft.below(9) : count; };
    std::string out;
    const std::size_t form = craft.below(4);
    const auto list = [&](std::size_t rows, int width, bool indices) {
        if (form == 1) out += craft.countNear(rows) + "\n";
        for (std::size_t i = 0; i < rows; ++i) {
            for (int k = 0; k < width; ++k)
                out +=
                    (indices ? craft.index(count) : craft.coordinate()) + (form == 2 ? ";" : " ");
            if (form != 2) out += "\n";
        }
        out += form == 3 ? "" : "\n";
    };
    if (form == 3) out += craft.countNear(count) + " " + craft.countNear(3) + "\n";
    list(near(), 3, false);
    if (form == 2) list(1 + craft.below(2), 3, true);
    if (craft.chance(2)) list(near(), 3, false);
    if (craft.chance(2)) list(near(), 2, false);
    if (form != 2) list(1 + craft.below(2), craft.chance(2) ? 3 : 1, true);
    return out;
}

std::string soup(Craft& craft) {
    constexpr std::array<int, 7> kWidths{3, 5, 6, 8, 9, 4, 1};
    const int width = kWidths[craft.below(kWidths.size())];
    std::string out = craft.chance(3) ? craft.countNear(6) + "\n" : "";
    const std::size_t rows = craft.below(13);
    for (std::size_t i = 0; i < rows; ++i) {
        const int own = craft.chance(20) ? static_cast<int>(craft.below(10)) : width;
        for (int k = 0; k < own; ++k) out += craft.coordinate() + " ";
        out += "\n";
    }
    return out;
}

/// The binary form, its checksum right whatever else is wrong.
std::string binary(Craft& craft) {
    const auto vertices = static_cast<std::uint32_t>(craft.below(9));
    const auto indices = static_cast<std::uint32_t>(3 * craft.below(3) + (craft.chance(6) ? 1 : 0));
    const auto flags = static_cast<std::uint32_t>(craft.below(5));
    std::string out = "FAROL3D\n";
    put(out, std::uint32_t{1}, false);
    put(out, flags, false);
    put(out, craft.chance(5) ? vertices + 0x55555556U : vertices, false);
    put(out, craft.chance(5) ? indices + 0x40000000U : indices, false);
    const std::uint32_t floats =
        vertices * (3 + ((flags & 1U) != 0 ? 3 : 0) + ((flags & 2U) != 0 ? 2 : 0));
    for (std::uint32_t k = 0; k < floats; ++k)
        put(out, craft.chance(25) ? std::numeric_limits<float>::quiet_NaN() : float(k % 5), false);
    for (std::uint32_t k = 0; k < indices; ++k)
        put(out, static_cast<std::uint32_t>(craft.below(vertices + 1)), false);
    std::uint64_t hash = 14695981039346656037U;
    for (const char c : out) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211U;
    put(out, hash, false);
    return out;
}

std::string patch(Craft& craft) {
    const std::size_t patches = 1 + craft.below(4), points = 1 + craft.below(20);
    std::string out = craft.countNear(patches) + "\n";
    for (std::size_t i = 0; i < patches; ++i) {
        for (int k = 0; k < 16; ++k)
            out += (craft.chance(30) ? craft.index(points) : std::to_string(craft.below(points))) +
                   (k == 15 ? "\n" : ",");
    }
    out += craft.countNear(points) + "\n";
    for (std::size_t i = 0; i < points; ++i)
        out += craft.coordinate() + ", " + craft.coordinate() + ", 0\n";
    return out;
}

struct Recipe {
    const char *name, *kind;
    std::string (*make)(Craft&);
};

constexpr std::array kRecipes{Recipe{"blocks.ply", "two blocks of vertices", plyTwoBlocks},
                              Recipe{"header.ply", "elements and properties", plyHeader},
                              Recipe{"lists.ply", "lengths of lists", plyLists},
                              Recipe{"polygon.ply", "many corners", plyPolygon},
                              Recipe{"indices.obj", "indices", obj},
                              Recipe{"polygon.obj", "many corners", objPolygon},
                              Recipe{"count.stl", "count against size", stl},
                              Recipe{"counts.off", "counts and indices", off},
                              Recipe{"lists.3d", "lists of other lengths", text3d},
                              Recipe{"soup.tri", "rows of other widths", soup},
                              Recipe{"counts.3db", "counts, flags, indices", binary},
                              Recipe{"indices.patch", "counts and indices", patch}};

}  // namespace

CraftedMesh craftMesh(std::uint64_t number) {
    Craft craft(number);
    const Recipe& recipe = kRecipes[number % kRecipes.size()];
    CraftedMesh mesh{recipe.name, recipe.kind, recipe.make(craft)};
    if (craft.chance(2) || mesh.bytes.empty()) return mesh;
    const std::size_t edits = 1 + craft.below(3);
    for (std::size_t k = 0; k < edits && !mesh.bytes.empty(); ++k) {
        const std::size_t at = craft.below(mesh.bytes.size());
        if (craft.chance(4))
            mesh.bytes.resize(at);
        else if (craft.chance(3))
            mesh.bytes.insert(at, 1 + craft.below(4), static_cast<char>(craft.below(256)));
        else
            mesh.bytes[at] = static_cast<char>(craft.below(256));
    }
    return mesh;
}

}  // namespace farol::fuzz
