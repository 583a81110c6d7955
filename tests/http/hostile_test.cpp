// Hostile requests: each case has its status and its code, no worker dies of it, and none
// takes more memory than it may.
#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

#include "real.h"
#include "tests/support/archives.h"
#include "tests/support/paths.h"
#include "tests/support/pool_process.h"

using namespace farol;
using namespace farol::test;

namespace {

constexpr std::size_t kCapMiB = 1024;

struct Case {
    std::string name, type, body;
    int status;
    std::string code;  ///< of the problem; "" for a picture
    std::string query = "";
};

constexpr const char* kXml = "application/xml";
constexpr const char* kZip = "application/zip";
constexpr const char* kTar = "application/x-tar";
constexpr const char* kGzip = "application/gzip";

std::string repeat(const std::string& text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i) all += text;
    return all;
}

std::string textured(const std::string& name) {
    return model("box_2_1.3d", "<texture file=\"" + name + "\"/>");
}

/// A scene and one file that it names.
std::string with(const std::string& scene, const std::string& name, const std::string& bytes) {
    return multipart({{"scene", "scene.xml", scene, ""}, {"file", name, bytes, ""}});
}

std::string bigEndian(std::uint32_t value) {
    std::string out;
    for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>((value >> shift) & 255U);
    return out;
}

std::string pngChunk(const std::string& kindAndData) {
    std::uint32_t crc = 0xFFFFFFFFU;
    for (const char c : kindAndData) {
        crc ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
    }
    return bigEndian(static_cast<std::uint32_t>(kindAndData.size() - 4)) + kindAndData +
           bigEndian(~crc);
}

/// A PNG whose head says that it is so large, and that has no pixels.
std::string pngOf(std::uint32_t width, std::uint32_t height) {
    return "\x89PNG\r\n\x1a\n" +
           pngChunk("IHDR" + bigEndian(width) + bigEndian(height) +
                    std::string("\x08\x02\0\0\0", 5)) +
           pngChunk("IDAT") + pngChunk("IEND");
}

std::vector<Case> xmlCases() {
    const std::string laughs = "<!DOCTYPE world [<!ENTITY a \"ha\">" + [] {
        std::string all;
        for (char c = 'b'; c < 'k'; ++c)
            all += std::string("<!ENTITY ") + c + " \"" +
                   repeat(std::string("&") + static_cast<char>(c - 1) + ";", 10) + "\">";
        return all;
    }() + "]><world>&j;</world>";
    return {
        {"entities in entities", kXml, laughs, 400, "xml.doctype"},
        {"an external entity", kXml,
         "<!DOCTYPE world [<!ENTITY x SYSTEM \"file:///etc/passwd\">]><world>&x;</world>", 400,
         "xml.doctype"},
        {"an external entity as a name", kXml,
         "<!DOCTYPE world [<!ENTITY x SYSTEM \"file:///etc/passwd\">]>" + textured("&x;"), 400,
         "xml.doctype"},
        {"an endless doctype", kXml, "<!DOCTYPE world [" + repeat("<!ENTITY a 'b'>", 20'000), 400,
         "xml.doctype"},
        {"depth 100,000", kXml, repeat("<group>", 100'000), 422, "limit.depth"},
        {"depth 100,000, closed", kXml,
         "<world>" + repeat("<group>", 60'000) + repeat("</group>", 60'000) + "</world>", 422,
         "limit.depth"},
        {"elements without end", kXml, "<world>" + repeat("<group/>", 100'000) + "</world>", 422,
         "limit.elements"},
        {"a document of 2 MiB", kXml, "<world>" + std::string(2U << 20U, ' ') + "</world>", 422,
         "limit.bytes"},
        {"attributes without end", kXml, "<world " + repeat("a='1' ", 100'000) + "/>", 200, ""},
        {"one attribute of 900 KiB", kXml, "<world a='" + std::string(900'000, 'x') + "'/>", 200,
         ""},
        {"a comment without end", kXml, "<world><!--" + std::string(500'000, '-'), 400,
         "xml.comment"},
        {"nothing but <", kXml, std::string(500'000, '<'), 400, "xml.no-root"},
        {"nothing but &", kXml, "<world>" + std::string(500'000, '&') + "</world>", 200, ""},
        {"NUL bytes", kXml, std::string("<world>\0\0\0</world>", 18), 400, "xml.character"},
        {"nothing but NUL", kXml, std::string(1000, '\0'), 400, "xml.no-root"},
        {"UTF-16 cut off", kXml, std::string("\xff\xfe<\0w\0/\0", 8), 400, "xml.tag"},
        {"no UTF-8", kXml, "<world>\xff\xfe\xfd</world>", 200, ""},
        {"random bytes", kXml,
         [] {
             std::string all;
             std::uint32_t x = 1;
             for (int i = 0; i < 100'000; ++i)
                 all += static_cast<char>((x = x * 1664525U + 1013904223U) >> 24U);
             return all;
         }(),
         400, "xml.character"},
        {"a processing instruction", kXml, "<?xml-stylesheet href='http://127.0.0.1/'?><world/>",
         200, ""},
        {"includes itself", kXml, world("<include file=\"scene.xml\"/>"), 422,
         "scene.include-cycle"},
        {"no world", kXml, "<svg><script>alert(1)</script></svg>", 422, "scene.root"},
    };
}

std::vector<Case> numberCases() {
    return {
        {"a sphere of 2e9 slices", kXml, model("sphere_1_2000000000_2000000000.3d"), 422,
         "shape.argument"},
        {"a sphere of 10000 x 10000", kXml, model("sphere_1_10000_10000.3d"), 422,
         "limit.triangles"},
        {"a plane of 1e9 divisions", kXml, model("plane_1_1000000000.3d"), 422, "shape.argument"},
        {"a torus below nothing", kXml, model("torus_-1_-1_-5_-5.3d"), 422, "shape.argument"},
        {"a number of a thousand digits", kXml, model("box_" + std::string(1000, '9') + "_1.3d"),
         422, "asset.missing"},
        {"a million spheres", kXml,
         world("<group><scatter count=\"1000000\"/><models><model "
               "file=\"sphere_1_50_50.3d\"/></models></group>"),
         422, "scene.range"},
        {"camera at NaN", kXml,
         "<world><camera><position x=\"nan\" y=\"inf\" z=\"1e999\"/></camera></world>", 422,
         "scene.number"},
        {"window of 1e9", kXml,
         "<world><window width=\"1000000000\" height=\"1000000000\"/>" +
             std::string("<group><models><model file=\"box_1_1.3d\"/></models></group></world>"),
         422, "scene.range"},
        {"width of 1e9", kXml, model("box_2_1.3d"), 400, "option.range", "?width=1000000000"},
        {"4096 x 4097", kXml, model("box_2_1.3d"), 400, "option.range", "?width=4096&height=4097"},
        {"minus one sample", kXml, model("box_2_1.3d"), 400, "option.range", "?aa=-1"},
        {"a field of view of 180", kXml, model("box_2_1.3d"), 400, "option.range", "?fov=180"},
        {"an option of 5000 bytes", kXml, model("box_2_1.3d"), 400, "option.range",
         "?shading=" + std::string(5000, 's')},
        {"an option twice", kXml, model("box_2_1.3d"), 400, "option.repeated", "?aa=1&aa=2"},
        {"an unknown option", kXml, model("box_2_1.3d"), 400, "option.unknown", "?__proto__=1"},
        {"a background outside", kXml, model("box_2_1.3d"), 400, "option.range",
         "?background=../../../../etc/passwd"},
        {"an entity outside", kXml, model("box_2_1.3d"), 400, "option.range",
         "?entity=/etc/passwd"},
    };
}

std::vector<Case> pathCases() {
    std::vector<Case> all;
    const std::pair<const char*, const char*> names[] = {
        {"up", "../../../../etc/passwd"},
        {"up by backslashes", "..\\..\\etc\\passwd"},
        {"absolute", "/etc/passwd"},
        {"a drive", "C:\\Windows\\win.ini"},
        {"a share", "\\\\server\\share\\a.png"},
        {"a URL", "http://127.0.0.1:1/a.png"},
        {"a file URL", "file:///etc/passwd"},
        {"a device", "/dev/zero"},
        {"a process", "/proc/self/environ"},
        {"home", "~/.ssh/id_rsa"},
        {"a folder", "."},
        {"dots", "a/./../../b.png"},
        {"a format string", "%s%s%s%n.png"},
    };
    for (const auto& [name, path] : names) {
        all.push_back(
            {std::string("a texture ") + name, kXml, textured(path), 422, "asset.missing"});
        all.push_back({std::string("a mesh ") + name, kXml, model(path), 422, "asset.missing"});
    }
    for (const auto& [name, path] : {std::pair{"up", "../evil.png"},
                                     {"absolute", "/tmp/evil.png"},
                                     {"up by backslashes", "..\\\\evil.png"},
                                     {"up within", "a/../../evil.png"},
                                     {"empty parts", "a//b.png"},
                                     {"a folder", "a/"}})
        all.push_back({std::string("a part's file name: ") + name, kMultipartType,
                       with(model("box_2_1.3d"), path, "x"), 400, "http.multipart"});
    all.push_back({"a part's file name: NUL", kMultipartType,
                   with(model("box_2_1.3d"), std::string("a\0.png", 6), "x"), 400,
                   "http.multipart"});
    all.push_back({"a part's file name of 4 KiB", kMultipartType,
                   with(model("box_2_1.3d"), std::string(4096, 'n'), "x"), 400, "http.multipart"});
    all.push_back({"a part's head with a line too many", kMultipartType,
                   with(model("box_2_1.3d"), "a.png\"\r\nX-Evil: 1\r\nx: \"", "x"), 200, ""});
    all.push_back({"a part without end", kMultipartType,
                   "--frontier\r\nContent-Disposition: form-data; name=\"scene\"\r\n\r\n<world/>",
                   400, "http.multipart"});
    all.push_back({"a part with a head of 100 KiB", kMultipartType,
                   "--frontier\r\n" + std::string(100'000, 'h') + "\r\n\r\nx\r\n--frontier--", 400,
                   "http.multipart"});
    all.push_back({"five thousand parts", kMultipartType,
                   multipart(std::vector<FilePart>(5000, {"f", "", "x", ""})), 400,
                   "http.multipart"});
    all.push_back({"options nested deep", kMultipartType,
                   multipart({{"scene", "", model("box_2_1.3d"), ""},
                              {"options", "", repeat("[", 100'000), ""}}),
                   400, "option.syntax"});
    return all;
}

std::vector<Case> fileCases() {
    const std::string scene = textured("t.png"), mesh = model("m.obj"), ply = model("m.ply"),
                      text = model("m.3d"), patch = model("m.patch");
    const auto texture = [&](const std::string& name, const std::string& bytes, int status,
                             const std::string& code) {
        return Case{"a texture " + name, kMultipartType, with(scene, "t.png", bytes), status, code};
    };
    return {
        texture("that is empty", "", 422, "image.unreadable"),
        texture("that says 60000 x 60000", pngOf(60'000, 60'000), 422, "limit.texture"),
        texture("that says 2^31 x 2^31", pngOf(0x7FFFFFFFU, 0x7FFFFFFFU), 422, "image.unreadable"),
        texture("of no size", pngOf(0, 0), 422, "image.unreadable"),
        texture("that ends in its head", pngOf(16, 16).substr(0, 20), 422, "image.unreadable"),
        texture("without pixels", pngOf(16, 16), 422, "image.unreadable"),
        texture("a BMP that says 2^31 rows",
                "BM" + std::string(16, '\0') + std::string("\xff\xff\xff\x7f\xff\xff\xff\x7f", 8) +
                    std::string(30, '\0'),
                422, "image.unreadable"),
        texture("a GIF of 65535 x 65535", std::string("GIF89a\xff\xff\xff\xff\0\0\0", 13), 422,
                "limit.texture"),
        texture("a PNM of 1e9 x 1e9", "P6\n1000000000 1000000000\n255\nx", 422, "limit.texture"),
        texture("a TIFF without end", std::string("II*\0\x08\0\0\0\xff\xff", 10), 422,
                "image.unreadable"),
        texture("a WebP of nothing", std::string("RIFF\xff\xff\xff\xffWEBPVP8 ", 16), 422,
                "image.unreadable"),
        texture("a JPEG of nothing", "\xff\xd8\xff\xe0", 422, "image.unreadable"),
        texture("an SVG", "<svg onload='alert(1)'/>", 422, "image.unreadable"),
        {"a .3d of 4e9 vertices", kMultipartType, with(text, "m.3d", "4000000000\n0 0 0\n"), 422,
         "mesh.truncated"},
        {"a .3d of minus one", kMultipartType, with(text, "m.3d", "-1\n0 0 0\n"), 422,
         "mesh.count"},
        {"a .3d of text", kMultipartType, with(text, "m.3d", repeat("lorem ipsum ", 1000)), 422,
         "mesh.format"},
        {"an empty mesh", kMultipartType, with(text, "m.3d", ""), 422, "mesh.empty"},
        {"an OBJ with indices beyond", kMultipartType,
         with(mesh, "m.obj", "v 0 0 0\nf 1 2 99999999999\n"), 422, "mesh.index"},
        {"an OBJ with a face of 100,000 corners", kMultipartType,
         with(mesh, "m.obj", "v 0 0 0\nf" + repeat(" 1", 100'000) + "\n"), 200, ""},
        {"an OBJ of NaN", kMultipartType, with(mesh, "m.obj", "v nan inf 1e999\nf 1 1 1\n"), 422,
         "mesh.number"},
        {"a PLY of 2e9 vertices", kMultipartType,
         with(ply, "m.ply",
              "ply\nformat binary_little_endian 1.0\nelement vertex 2000000000\nproperty float "
              "x\nproperty float y\nproperty float z\nend_header\n"),
         422, "mesh.count"},
        {"a PLY whose head has no end", kMultipartType,
         with(ply, "m.ply", "ply\n" + repeat("comment x\n", 50'000)), 422, "mesh.truncated"},
        {"a PLY list of 4e9", kMultipartType,
         with(
             ply, "m.ply",
             "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\nproperty "
             "float y\n"
             "property float z\nelement face 1\nproperty list uint int vertex_index\nend_header\n" +
                 std::string(12, '\0') + "\xff\xff\xff\xff"),
         422, "mesh.count"},
        {"a patch file of 1e9 patches", kMultipartType,
         with(patch, "m.patch", "1000000000\n0,1,2\n"), 422, "mesh.truncated"},
        {"a patch file with indices beyond", kMultipartType,
         with(patch, "m.patch", "1\n0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,99999\n1\n0,0,0\n"), 422,
         "mesh.index"},
    };
}

std::vector<Case> archiveCases() {
    const Packed scene{"scene.xml", model("box_2_1.3d")};
    const std::string zeros(std::size_t{48} << 20U, '\0');
    const std::string good = pack(Packing::zip, {scene, {"t.png", std::string(5000, 't')}});
    std::string bent = good;
    for (std::size_t i = 30; i < bent.size(); i += 40) bent[i] = '\xff';
    return {
        {"a zip bomb", kZip,
         pack(Packing::zip, {{"scene.xml", textured("t.png")}, {"t.png", zeros}}), 422,
         "limit.bundle"},
        {"a zip bomb that nothing names", kZip, pack(Packing::zip, {scene, {"t.png", zeros}}), 200,
         ""},
        {"a tar.gz bomb", kGzip, pack(Packing::tarGz, {scene, {"t.png", zeros}}), 422,
         "limit.bundle"},
        {"a bomb among what is skipped", kGzip,
         pack(Packing::tarGz, {{"__MACOSX/x", zeros}, scene}), 422, "limit.bundle"},
        {"60,000 entries", kGzip,
         [&] {
             std::vector<Packed> many{scene};
             for (int i = 0; i < 60'000; ++i) many.push_back({std::to_string(i), "", AE_IFDIR});
             return pack(Packing::tarGz, many);
         }(),
         422, "limit.bundle"},
        {"a name up in a zip", kZip, pack(Packing::zip, {scene, {"../t.png", "x"}}), 400,
         "bundle.path"},
        {"an absolute name in a tar", kTar, pack(Packing::tar, {scene, {"/etc/cron.d/x", "x"}}),
         400, "bundle.path"},
        {"a name twice", kTar, pack(Packing::tar, {scene, {scene.path, "<scene/>"}}), 400,
         "bundle.path"},
        {"a symbolic link in a tar", kTar,
         pack(Packing::tar, {scene, {"t.png", "", AE_IFLNK, "/etc/passwd"}}), 200, ""},
        {"a symbolic link in a zip that the scene names", kZip,
         pack(Packing::zip,
              {{"scene.xml", textured("t.png")}, {"t.png", "", AE_IFLNK, "/etc/passwd"}}),
         422, "asset.missing"},
        {"a hard link that the scene names", kTar,
         pack(Packing::tar,
              {{"scene.xml", textured("t.png")}, {"t.png", "", AE_IFREG, "", "/etc/passwd"}}),
         422, "asset.missing"},
        {"a device", kTar, pack(Packing::tar, {scene, {"zero", "", AE_IFCHR}}), 200, ""},
        {"half a zip", kZip, good.substr(0, good.size() / 2), 400, "bundle.damaged"},
        {"a bent zip", kZip, bent, 400, "bundle.damaged"},
        {"a zip that is a name", kZip, "PK\3\4", 400, "bundle.damaged"},
        {"a gzip of nothing", kGzip, "\x1f\x8b\x08", 400, "bundle.damaged"},
        {"an archive without a scene", kZip, pack(Packing::zip, {{"t.png", "x"}}), 400,
         "bundle.no-scene"},
        {"an archive of two scenes", kZip, pack(Packing::zip, {{"a.xml", "x"}, {"b.xml", "x"}}),
         400, "bundle.which-scene"},
        {"an archive in an archive", kZip, pack(Packing::zip, {{"scene.xml", good}}), 400,
         "xml.character"},
        {"XML that says it is a zip", kZip, model("box_2_1.3d"), 400, "bundle.damaged"},
        {"a program", "application/octet-stream",
         "\x7f"
         "ELF\2\1\1",
         415, "http.media-type"},
        {"a RAR file that ends", "application/vnd.rar", "Rar!\x1a\7", 400, "bundle.damaged"},
        {"a 7z file that ends", "application/x-7z-compressed", "7z\xBC\xAF\x27\x1C", 400,
         "bundle.damaged"},
        {"oversize", kZip, std::string(17U << 20U, 'z'), 413, "limit.body"},
    };
}

/// The most memory that the process has had, MiB.
std::size_t peakMiB(pid_t pid) {
    std::ifstream status("/proc/" + std::to_string(pid) + "/status");
    for (std::string line; std::getline(status, line);)
        if (line.rfind("VmHWM:", 0) == 0) return std::stoul(line.substr(6)) / 1024;
    return 0;
}

}  // namespace

TEST_CASE("hostile input has its status and its code, and hurts nobody") {
    worker::PoolOptions options;
    options.queue = {64, std::chrono::milliseconds(60'000), std::chrono::milliseconds(60'000)};
    options.worker.program = farol::test::kProgram;
    options.worker.memoryBytes = kCapMiB << 20U;
    options.spares = 0;
    const std::set<pid_t> others = childrenNow();
    worker::WorkerPool backend(options, [](const std::string&, const std::string&) {});
    TestServer server(backend);
    const pid_t before = workerOf(backend, others);

    std::vector<Case> table;
    for (const auto& cases : {xmlCases(), numberCases(), pathCases(), fileCases(), archiveCases()})
        table.insert(table.end(), cases.begin(), cases.end());
    CHECK(table.size() >= 100);
    for (const Case& one : table) {
        const Answer answer = post(server.port(), "/v1/render" + one.query, one.body, one.type);
        INFO(one.name << ": " << answer.status << " " << answer.code() << " "
                      << (answer.code().empty() ? "" : answer.json()["detail"].dump()));
        CHECK(answer.status == one.status);
        CHECK(answer.code() == one.code);
        CHECK(answer.body.find("root:") == std::string::npos);  // of /etc/passwd
        CHECK(answer.headers.count("x-evil") == 0);
        CHECK(answer.body.size() < 20'000);
    }
    CHECK(workerOf(backend, others) == before);  // the same worker all the time
    const std::size_t peak = peakMiB(before);
    WARN("the worker's memory had a peak of " << peak << " MiB, of " << kCapMiB);
    CHECK(peak < kCapMiB);
    CHECK(post(server.port(), "/v1/render", model("box_2_1.3d")).status == 200);
}
