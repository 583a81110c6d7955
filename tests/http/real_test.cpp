// The whole path over HTTP with the real reader and renderer behind it.
#include "real.h"

#include <catch2/catch.hpp>
#include <thread>

#include "fixture.h"
#include "image/image_file.h"
#include "tests/support/paths.h"
#include "worker/pool.h"

using namespace farol;
using namespace farol::test;

namespace {

std::string repeated(const std::string& text, int times) {
    std::string out;
    for (int i = 0; i < times; ++i) out += text;
    return out;
}

struct BadInput {
    const char* name;
    std::string body;
    std::string query;
    int status;
    std::string family;  ///< the code is it, or starts with it when it ends with '.'
    int line;            ///< of the first error; 0: none is expected
};

bool fits(const std::string& code, const std::string& family) {
    return family.back() == '.' ? code.rfind(family, 0) == 0 : code == family;
}

}  // namespace

TEST_CASE("a scene posted is a picture returned") {
    RealServer server;
    const std::string scene =
        model("sphere_1_20_20.3d", "<color><diffuse R=\"255\" G=\"0\" B=\"0\"/></color>");
    const Answer answer =
        post(server.port(), "/v1/render?shading=solid&background=%23000040", scene);
    REQUIRE(answer.status == 200);
    CHECK(answer.header("content-type") == "image/png");
    const image::Image image = image::decodeImage(answer.body, "answer.png");
    REQUIRE(image.width == 64);
    REQUIRE(image.height == 48);
    const std::uint8_t* middle = &image.pixels[(24 * 64 + 32) * 4];
    CHECK(middle[0] > 200);
    CHECK(middle[2] < 50);
    CHECK(image.pixels[2] == 0x40);
    for (const char* stage : {"queue", "parse", "geometry", "draw", "readback", "encode"})
        CHECK(answer.header("server-timing").find(std::string(stage) + ";dur=") !=
              std::string::npos);
    const auto stats = nlohmann::json::parse(answer.header("x-farol-stats"), nullptr, false);
    CHECK(stats.value("instances", 0) == 1);
    CHECK(stats.value("triangles", 0) > 100);
    const auto camera = nlohmann::json::parse(answer.header("x-farol-camera"), nullptr, false);
    CHECK(camera["eye"] == nlohmann::json::array({0.0, 0.0, 5.0}));

    CHECK(post(server.port(), "/v1/render?format=jpeg", scene).header("content-type") ==
          "image/jpeg");
    const Answer small = post(server.port(), "/v1/render?width=200&height=100&scale=0.5", scene);
    const image::Image half = image::decodeImage(small.body, "half.png");
    CHECK(half.width == 100);
    CHECK(half.height == 50);
    CHECK(post(server.port(), "/v1/render", scene).body ==
          post(server.port(), "/v1/render", scene).body);
}

TEST_CASE("placeholders are drawn on demand, with the errors in a bounded header") {
    RealServer server;
    std::string models;
    for (int i = 0; i < 200; ++i)
        models += "<model file=\"box_1.3d\"><texture file=\"gone" + std::to_string(i) +
                  ".png\"/></model>";
    const std::string scene = world("<group><models>" + models + "</models></group>");
    CHECK(post(server.port(), "/v1/render", scene).status == 422);
    const Answer answer = post(server.port(), "/v1/render?missing=placeholder", scene);
    REQUIRE(answer.status == 200);
    CHECK(answer.header("content-type") == "image/png");
    const std::string header = answer.header("x-farol-diagnostics");
    CHECK(header.size() < 4000);
    const auto found = nlohmann::json::parse(header, nullptr, false);
    CHECK(found.at(0).at("code") == "asset.missing");
    CHECK(found.at(0).at("severity") == "error");
    CHECK(found.at(0).at("message").get<std::string>().find("gone0.png") != std::string::npos);
    CHECK(post(server.port(), "/v1/render?missing=never", scene).status == 400);
}

TEST_CASE("a scene with its texture is posted in parts") {
    RealServer server;
    // A picture of two pixels by one: PPM is the shortest to write by hand.
    const std::string picture = std::string("P6\n1 1\n255\n") + "\x10\xF0\x10";
    const std::string scene = model(
        "plane_10_1.3d",
        "<texture file=\"green.ppm\"/><color><diffuse R=\"255\" G=\"255\" B=\"255\"/></color>");
    const std::string with =
        multipart({{"scene", "s.xml", scene, ""},
                   {"file", "green.ppm", picture, ""},
                   {"options", "", R"({"eye": [0,4,1], "shading":"solid"})", ""}});
    const Answer answer = post(server.port(), "/v1/render", with, kMultipartType);
    REQUIRE(answer.status == 200);
    const image::Image image = image::decodeImage(answer.body, "answer.png");
    const std::uint8_t* middle = &image.pixels[(24 * 64 + 32) * 4];
    CHECK(middle[1] > 200);
    CHECK(middle[0] < 60);
    const Answer without = post(server.port(), "/v1/render", scene);
    CHECK(without.status == 422);
    CHECK(without.code() == "asset.missing");
}

TEST_CASE("bad input is never a crash and never a 200") {
    RealServer server;
    const std::string box = model("box_2_3.3d");
    const std::string picture = "<texture file=\"t.png\"/>";
    const std::vector<BadInput> table = {
        {"empty body", "", "", 400, "xml.empty", 0},
        {"blanks", "  \n ", "", 400, "xml.", 0},
        {"no XML", "solid teapot\n", "", 400, "xml.", 0},
        {"binary", std::string("\x89PNG\r\n\x1a\n\0\0\0", 11), "", 400, "xml.", 0},
        {"truncated in a tag", box.substr(0, box.size() / 2), "", 400, "xml.", 0},
        {"truncated before the end", box.substr(0, box.size() - 12), "", 400, "xml.", 0},
        {"mismatched tags", "<world><group></world></group>", "", 400, "xml.", 1},
        {"HTML", "<html><body/></html>", "", 422, "scene.", 1},
        {"unknown shape", model("dodo_1_2.3d"), "", 422, "asset.missing", 5},
        {"unknown element", world("<grup/>"), "?strict=1", 422, "scene.unknown-element", 4},
        {"missing mesh", model("there-is-none.3d"), "", 422, "asset.missing", 5},
        {"missing texture", model("box_2_3.3d", picture), "", 422, "asset.missing", 5},
        {"shape arguments", model("sphere_1_0_10.3d"), "", 422, "shape.argument", 5},
        {"too many triangles", model("sphere_1_100000_100000.3d"), "", 422, "", 5},
        {"NaN in a translate",
         world("<group><transform><translate x=\"nan\" y=\"0\" z=\"0\"/></transform></group>"), "",
         422, "scene.number", 4},
        {"infinite scale",
         world("<group><transform><scale x=\"1e999\" y=\"1\" z=\"1\"/></transform></group>"), "",
         422, "scene.", 4},
        {"words for numbers",
         world("<group><transform><translate x=\"one\" y=\"0\" z=\"0\"/></transform></group>"), "",
         422, "scene.number", 4},
        {"100,000 nested groups",
         "<world>" + repeated("<group>", 100'000) + repeated("</group>", 100'000) + "</world>", "",
         422, "limit.", 0},
        {"100,000 open groups", "<world>" + repeated("<group>", 100'000), "", 0, "", 0},
        {"a million elements", "<world>" + repeated("<group/>", 120'000) + "</world>", "", 422,
         "limit.", 0},
        {"two megabytes", world("<!--" + std::string(2'000'000, 'x') + "-->"), "", 422, "limit.",
         0},
        {"entity bomb",
         "<!DOCTYPE w [<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b \"&a;&a;&a;&a;\">]><world>&b;</world>",
         "", 400, "xml.", 0},
        {"external entity",
         "<!DOCTYPE w [<!ENTITY a SYSTEM \"file:///etc/passwd\">]><world>&a;</world>", "", 400,
         "xml.", 0},
        {"fov 0 in the scene",
         "<world><camera><position x=\"1\" y=\"1\" z=\"1\"/><lookAt x=\"0\" y=\"0\" z=\"0\"/>"
         "<up x=\"0\" y=\"1\" z=\"0\"/><projection fov=\"0\" near=\"1\" "
         "far=\"100\"/></camera></world>",
         "", 422, "scene.", 1},
        {"window 0", "<world><window width=\"0\" height=\"5\"/></world>", "", 422, "", 1},
        {"window 100000", "<world><window width=\"100000\" height=\"5\"/></world>", "", 422, "", 1},
        {"width=0", box, "?width=0", 400, "option.range", 0},
        {"width=100000", box, "?width=100000", 400, "option.range", 0},
        {"width=-1", box, "?width=-1", 400, "option.range", 0},
        {"width=1e3", box, "?width=1e3", 400, "option.range", 0},
        {"height=nan", box, "?height=nan", 400, "option.range", 0},
        {"fov=0", box, "?fov=0", 400, "option.range", 0},
        {"fov=180", box, "?fov=180", 400, "option.range", 0},
        {"aa=3", box, "?aa=3", 400, "option.range", 0},
        {"eye=target", box, "?eye=1,1,1&target=1,1,1", 400, "option.", 0},
        {"near beyond far", box, "?near=10&far=5", 400, "option.", 0},
        {"background that is not there", box, "?background=none.png", 400, "option.range", 0},
        {"time=nan", box, "?time=nan", 400, "option.range", 0},
    };
    for (const BadInput& row : table) {
        INFO(row.name);
        for (const char* route : {"/v1/render", "/v1/validate"}) {
            const bool validate = std::string(route) == "/v1/validate";
            if (validate && !row.query.empty()) continue;  // it has no picture options
            INFO(route);
            const Answer answer = post(server.port(), route + row.query, row.body);
            INFO(answer.body);
            if (row.status != 0) CHECK(answer.status == row.status);
            CHECK(answer.status >= 400);
            CHECK(answer.status < 500);
            CHECK(answer.header("content-type") == "application/problem+json");
            if (!row.family.empty()) CHECK(fits(answer.code(), row.family));
            const auto problem = answer.json();
            REQUIRE(problem.is_object());
            bool located = row.line == 0;
            for (const auto& error : problem["errors"])
                located =
                    located || (error["severity"] == "error" &&
                                error.value("line", 0) == row.line && error.value("column", 0) > 0);
            CHECK(located);
        }
    }
    const std::vector<std::pair<const char*, std::string>> notPictures = {
        {"text", "this is not a picture"},
        {"nothing", ""},
        {"head alone", std::string("\x89PNG\r\n\x1a\n", 8)},
        {"a JPEG's start", std::string("\xFF\xD8\xFF\xE0\x00\x10JFIF", 10)}};
    for (const auto& [name, bytes] : notPictures) {
        INFO(name);
        const std::string body = multipart({{"scene", "s.xml", model("box_2_3.3d", picture), ""},
                                            {"file", "t.png", bytes, "image/png"}});
        const Answer answer = post(server.port(), "/v1/render", body, kMultipartType);
        CHECK(answer.status == 422);
        CHECK(answer.code() == "image.unreadable");
    }
    // None of it did any harm.
    CHECK(post(server.port(), "/v1/render", box).status == 200);
    CHECK(get(server.port(), "/readyz").status == 200);
}

TEST_CASE("a picture that was sent is kept, and says so") {
    server::ServiceOptions options;
    options.scenesDir = std::string(farol::test::kSourceDir) + "/scenes";
    RealServer server(options);
    const std::string id = get(server.port(), "/v1/scenes").json()["scenes"][0]["id"];
    const std::string path = "/v1/scenes/" + id + "/image?width=32&height=32";
    const Answer drawn = get(server.port(), path);
    const Answer kept = get(server.port(), path);
    REQUIRE(drawn.status == 200);
    CHECK(kept.body == drawn.body);
    CHECK(kept.header("etag") == drawn.header("etag"));
    CHECK(kept.header("x-farol-stats") == drawn.header("x-farol-stats"));
    CHECK(drawn.header("server-timing").find("draw;dur=") != std::string::npos);
    CHECK(kept.header("server-timing") == "cache;desc=hit");
    const std::string metrics = get(server.port(), "/metrics").body;
    for (const char* result : {"hit", "miss"})
        CHECK(metrics.find("farol_cache_requests_total{cache=\"picture\",result=\"" +
                           std::string(result) + "\"} 1\n") != std::string::npos);
}

TEST_CASE("frames of a session have a number, and an old one is not drawn") {
    server::ServiceOptions options;
    options.scenesDir = std::string(farol::test::kSourceDir) + "/scenes";
    RealServer server(options);
    const std::string id = get(server.port(), "/v1/scenes").json()["scenes"][0]["id"];
    const auto ask = [&](const std::string& query) {
        return get(server.port(), "/v1/scenes/" + id + "/image?width=24&height=24&" + query);
    };
    const Answer second = ask("azimuth=1&session=page-1&seq=2");
    CHECK(second.status == 200);
    const Answer first = ask("azimuth=2&session=page-1&seq=1");
    CHECK(first.status == 409);
    CHECK(first.code() == "busy.superseded");
    CHECK(ask("azimuth=2&session=page-2&seq=1").status == 200);
    // The frame's number is no part of the picture.
    CHECK(ask("azimuth=1&session=page-1&seq=9007199254740991").header("etag") ==
          second.header("etag"));
    for (const char* wrong : {"session=a", "seq=1", "session=a%20b&seq=1", "session=a&seq=-1",
                              "session=a&seq=1.5", "session=a&seq=9007199254740992"}) {
        INFO(wrong);
        const Answer refused = ask(wrong);
        CHECK(refused.status == 400);
        CHECK(refused.code() == "option.range");
    }
}

TEST_CASE("a scene that can be drawn is valid and counted") {
    RealServer server;
    const auto report = post(server.port(), "/v1/validate", model("box_2_3.3d")).json();
    CHECK(report["valid"] == true);
    CHECK(report["counts"]["triangles"] == 108);
    CHECK(report["counts"]["models"] == 1);
    CHECK(report["width"] == 64);
    CHECK(report["camera"]["fov"] == 60.0);
}

TEST_CASE("primitives are generated, and their arguments checked") {
    RealServer server;
    const Answer mesh = get(server.port(), "/v1/primitives/box?args=2%203&format=obj");
    CHECK(mesh.status == 200);
    CHECK(mesh.header("content-type") == "model/obj");
    CHECK(mesh.body.find("\nf ") != std::string::npos);
    for (const char* format : {"3d", "obj", "ply"})
        CHECK(
            get(server.port(), std::string("/v1/primitives/torus?args=2,0.5,8,8&format=") + format)
                .status == 200);
    const auto shapes = get(server.port(), "/v1/primitives").json()["shapes"];
    CHECK(shapes.size() >= 7);
    for (const char* args :
         {"1,0,10", "nan,10,10", "1,2", "1,10,10,10,10", "-1,10,10", "1,2.5,10"}) {
        INFO(args);
        const Answer answer = get(server.port(), std::string("/v1/primitives/sphere?args=") + args);
        CHECK(answer.status == 400);
        CHECK(answer.code() == "shape.argument");
        CHECK(answer.json()["errors"][0]["field"] == "args");
    }
    const Answer huge = get(server.port(), "/v1/primitives/sphere?args=1,1000,1000");
    CHECK(huge.status == 422);
    CHECK(huge.code() == "limit.triangles");
    const Answer file = get(server.port(), "/v1/primitives/patch?args=../../etc/passwd,3");
    CHECK(file.status >= 400);
    CHECK(file.status < 500);
}

TEST_CASE("the served examples have pictures, and broken ones are listed with their errors") {
    server::ServiceOptions options;
    options.scenesDir = std::string(farol::test::kSourceDir) + "/scenes";
    RealServer server(options);
    const auto list = get(server.port(), "/v1/scenes").json();
    REQUIRE(list["total"].get<int>() >= 6);
    for (const auto& scene : list["scenes"]) {
        INFO(scene["id"]);
        const std::string link = scene["links"]["thumbnail"];
        const Answer answer = get(server.port(), link + "?width=40&height=30&aa=1");
        if (answer.status == 422 && scene["valid"] == true) {
            // A picture that cannot be decoded is found when it is decoded, not before.
            CHECK(answer.code() == "image.unreadable");
        } else if (scene["valid"] == true) {
            CHECK(answer.status == 200);
            CHECK(answer.header("content-type") == "image/jpeg");
            CHECK_FALSE(scene["title"].get<std::string>().empty());
        } else {
            CHECK(answer.status >= 400);
            CHECK(answer.status < 500);
            CHECK(scene["diagnostics"][0].contains("message"));
        }
    }
}

TEST_CASE("many clients at once get the right pictures") {
    RealServer server;
    const std::string scene = model("teapot.patch");
    const std::string box = model("box_2_3.3d");
    const std::string expected =
        post(server.port(), "/v1/render?azimuth=30&elevation=10&distance=6", box).body;
    std::atomic<int> wrong{0};
    std::vector<std::thread> clients;
    for (int i = 0; i < 6; ++i)
        clients.emplace_back([&, i] {
            for (int k = 0; k < 10; ++k) {
                const Answer other = post(
                    server.port(),
                    "/v1/render?azimuth=" + std::to_string(i * 10 + k) + "&elevation=10&distance=6",
                    box);
                const Answer same =
                    post(server.port(), "/v1/render?azimuth=30&elevation=10&distance=6", box);
                if (other.status != 200 || same.status != 200 || same.body != expected) ++wrong;
            }
        });
    for (std::thread& client : clients) client.join();
    CHECK(wrong == 0);
}

TEST_CASE("a scene is compared with a picture of it, drawn as large") {
    RealServer server;
    const std::string box = model("box_2_3.3d");
    const std::string picture = post(server.port(), "/v1/render?width=40&height=30", box).body;
    const auto compared = [&](const std::string& query, const std::string& other) {
        return post(server.port(), "/v1/compare" + query,
                    multipart({{"first", "a.png", picture, ""}, {"second", "b.xml", other, ""}}),
                    kMultipartType);
    };
    const Answer same = compared("?pictures=1", box);
    REQUIRE(same.status == 200);
    CHECK(same.json()["width"] == 40);
    CHECK(same.json()["max"] == 0);
    CHECK(same.json()["psnr"].is_null());
    for (const char* name : {"diff", "heat"})
        CHECK(same.json()[name].get<std::string>().starts_with("data:image/png;base64,"));
    const Answer other = compared("", model("sphere_1_8_8.3d"));
    CHECK(other.json()["max"] > 50);
    CHECK_FALSE(other.json().contains("diff"));
    CHECK(compared("?width=20&height=15", box).code() == "image.size");
    CHECK(compared("?crop=400x400%2B0%2B0", box).code() == "image.crop");
}
