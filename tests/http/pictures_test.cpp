// Requests about images: errors as pictures, turntables, models, search; then the same
// with the real renderer.
#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

#include "fixture.h"
#include "image/image_file.h"
#include "real.h"
#include "tests/support/errors.h"
#include "worker/tasks/turntable.h"

using namespace farol;
using namespace farol::test;

namespace {

server::ServiceOptions serving(const TemporaryFolder& folder) {
    folder.write("red/box.xml", "<world>box</world>");
    folder.write("torch.xml", "<world>torch</world>");
    server::ServiceOptions options;
    options.scenesDir = folder.path();
    return options;
}

std::uint32_t numberAt(const image::Image& image, int x, int y) {
    const std::uint8_t* p = &image.pixels[static_cast<std::size_t>(y * image.width + x) * 4];
    return (std::uint32_t{p[0]} << 16U) | (std::uint32_t{p[1]} << 8U) | p[2];
}

}  // namespace

TEST_CASE("with onerror=image a fault is a picture under its own status") {
    const TemporaryFolder folder("http-onerror");
    FakeServer server(serving(folder));
    server.backend.onRender = [](const render::Job& job) -> render::Picture {
        throw test::errorOf("scene.empty", "nothing there", {job.name, 3, 7});
    };
    const Answer plain = get(server.port(), "/v1/scenes/torch/image?onerror=problem");
    CHECK(plain.status == 422);
    CHECK(plain.code() == "scene.empty");
    const Answer drawn = get(server.port(), "/v1/scenes/torch/image?onerror=image");
    CHECK(drawn.status == 422);
    CHECK(drawn.header("content-type") == "image/png");
    CHECK(drawn.body.find("torch.xml:3:7: nothing there [scene.empty]") != std::string::npos);
    CHECK(nlohmann::json::parse(drawn.header("x-farol-diagnostics"))[0]["line"] == 3);
    for (const auto& [target, status] : std::vector<std::pair<const char*, int>>{
             {"/v1/scenes/nope/image?onerror=image", 404},
             {"/v1/scenes/torch/image?onerror=image&width=0", 400},
             {"/v1/scenes/torch/thumbnail?onerror=image&bad=1", 400},
             {"/v1/scenes/torch/turntable?onerror=image&frames=1", 400}}) {
        INFO(target);
        const Answer answer = get(server.port(), target);
        CHECK(answer.status == status);
        CHECK(answer.header("content-type") == "image/png");
    }
    CHECK(post(server.port(), "/v1/render?onerror=image", "").header("content-type") ==
          "image/png");
    // Where nothing is drawn, or the word is another, it is a problem document.
    CHECK(get(server.port(), "/v1/scenes/torch?onerror=image").code() == "option.unknown");
    CHECK(get(server.port(), "/v1/scenes/torch/image?onerror=text").code() == "option.range");
    CHECK(get(server.port(), "/v1/scenes/torch/image?onerror=image", {{"Accept", "text/html"}})
              .header("content-type") == "application/problem+json");
}

TEST_CASE("a turntable is an animated PNG or its pictures one by one") {
    const TemporaryFolder folder("http-turn");
    FakeServer server(serving(folder));
    const std::string target = "/v1/scenes/torch/turntable";
    const auto typeOf = [&](const std::string& query, const std::string& accept) {
        return get(server.port(), target + query, {{"Accept", accept}}).header("content-type");
    };
    CHECK(typeOf("", "*/*") == "image/apng");
    CHECK(typeOf("", "image/avif,image/webp,image/apng,*/*;q=0.8") == "image/apng");
    CHECK(typeOf("", "multipart/x-mixed-replace").rfind("multipart/", 0) == 0);
    CHECK(typeOf("?format=webp", "*/*").rfind("multipart/", 0) == 0);
    CHECK(typeOf("?format=apng", "image/png") == "image/apng");
    CHECK(typeOf("?format=gif", "image/gif") == "image/gif");
    CHECK(typeOf("?format=animated-webp", "image/*") == "image/webp");
    CHECK(get(server.port(), target + "?frames=9").body == "9 pictures of torch.xml");
    const std::string tag = get(server.port(), target).header("etag");
    CHECK(get(server.port(), target + "?frames=23").header("etag") != tag);
    const int renders = server.backend.renders;
    CHECK(get(server.port(), target, {{"If-None-Match", tag}}).status == 304);
    CHECK(server.backend.renders == renders);
    for (const char* bad : {"?frames=1", "?frames=121", "?frames=x", "?fps=0", "?format=bmp",
                            "?frames=120&width=1024&height=1024"})
        CHECK(get(server.port(), target + bad).status == 400);
    CHECK(get(server.port(), target, {{"Accept", "text/html"}}).status == 406);
}

TEST_CASE("what moves in a turntable, and how many frames, is in its request") {
    const TemporaryFolder folder("http-turn-over");
    FakeServer server(serving(folder));
    worker::TurntableTask::Request last;
    server.backend.on<worker::TurntableTask>([&](const worker::TurntableTask::Request& request) {
        last = request;
        return render::Picture{};
    });
    const std::string target = "/v1/scenes/torch/turntable";
    struct Row {
        const char* query;
        bool isCameraTurning;
        int frames;
        double fps;
    };
    for (const Row& row :
         {Row{"", true, 24, 12}, Row{"?over=camera&fps=5", true, 24, 5},
          Row{"?over=time", false, 24, 0}, Row{"?over=time&frames=40", false, 40, 0},
          Row{"?over=time&fps=25", false, 0, 25},
          Row{"?over=time&fps=25&frames=9", false, 9, 25}}) {
        INFO(row.query);
        CHECK(get(server.port(), target + row.query).status == 200);
        CHECK(last.isCameraTurning == row.isCameraTurning);
        CHECK(last.frames == row.frames);
        CHECK(last.fps == row.fps);
    }
    CHECK(get(server.port(), target + "?over=moon").code() == "option.range");
    CHECK(get(server.port(), target + "?over=time&frames=").status == 400);
    CHECK(get(server.port(), target + "?over=time").header("etag") !=
          get(server.port(), target + "?over=camera").header("etag"));
}

TEST_CASE("the gallery is searched by words") {
    const TemporaryFolder folder("http-search");
    FakeServer server(serving(folder));
    const auto found = [&](const std::string& words) {
        std::string ids;
        const auto list = get(server.port(), "/v1/scenes?q=" + words).json();
        for (const auto& one : list["scenes"]) ids += one["id"].get<std::string>() + " ";
        return ids;
    };
    CHECK(found("") == "red/box torch ");
    CHECK(found("BOX") == "red/box ");
    CHECK(found("title+torch") == "torch ");
    CHECK(found("box+torch") == "");
    CHECK(get(server.port(), "/v1/scenes?q=none").json()["total"] == 0);
}

TEST_CASE("an entity tag is of the content, not of the file") {
    const TemporaryFolder here("http-replica-1"), there("http-replica-2");
    FakeServer one(serving(here)), two(serving(there));
    const std::string target = "/v1/scenes/red/box/image";
    const std::string tag = get(one.port(), target).header("etag");
    CHECK(tag == get(two.port(), target).header("etag"));
    there.write("red/wood.png", "another file");
    CHECK(tag != get(two.port(), target).header("etag"));
    here.write("red/wood.png", "another file");
    CHECK(get(one.port(), target).header("etag") == get(two.port(), target).header("etag"));
    here.write("red/wood.png", "another bile");
    CHECK(get(one.port(), target).header("etag") != get(two.port(), target).header("etag"));
}

TEST_CASE("the numbers of a picture lead to the lines of the document") {
    RealServer server;
    const std::string scene = world(
        "<group><translate x=\"-1\" y=\"0\" z=\"0\"/><models>\n"
        "<model file=\"box_1_1.3d\" id=\"left\"/></models></group>\n"
        "<group><translate x=\"1\" y=\"0\" z=\"0\"/><models>\n"
        "  <model file=\"sphere_0.5_8_8.3d\"/></models></group>");
    const Answer report = post(server.port(), "/v1/validate?models=1", scene);
    REQUIRE(report.status == 200);
    const auto facts = report.json();
    CHECK_FALSE(post(server.port(), "/v1/validate", scene).json().contains("models"));
    const Answer kept = post(server.port(), "/v1/scenes", scene);
    const auto models = get(server.port(), kept.header("location") + "/models").json();
    CHECK(models["models"] == facts["models"]);
    CHECK(models["copies"] == facts["copies"]);
    const image::Image image = image::decodeImage(
        post(server.port(), "/v1/render?layer=id&width=64&height=48", scene).body, "id.png");
    const auto at = [&](int x) {
        const std::uint32_t number = numberAt(image, x, 24);
        REQUIRE(number > 0);
        return models["models"][models["copies"][number - 1].get<std::size_t>()];
    };
    CHECK(at(22)["id"] == "left");
    CHECK(at(22)["model"] == "box_1_1.3d");
    CHECK(at(42)["model"] == "sphere_0.5_8_8.3d");
    CHECK(at(42)["line"].get<int>() == at(22)["line"].get<int>() + 2);
    CHECK(at(42)["file"] == "scene.xml");
    CHECK(numberAt(image, 1, 1) == 0);
}

TEST_CASE("a turntable of a real scene turns, and an error is drawn") {
    RealServer server;
    const std::string at =
        post(server.port(), "/v1/scenes", model("box_2_1.3d")).header("location");
    const Answer turn = get(server.port(), at + "/turntable?frames=4&width=64&height=48");
    REQUIRE(turn.status == 200);
    CHECK(turn.body.find("acTL") != std::string::npos);
    const Answer parts =
        get(server.port(), at + "/turntable?frames=3&format=png&width=64&height=48");
    REQUIRE(parts.status == 200);
    std::vector<std::string> frames;
    for (std::size_t from = 0; (from = parts.body.find("\x89PNG", from)) != std::string::npos;) {
        const std::size_t end = parts.body.find("\r\n--farol-frame", from);
        frames.push_back(parts.body.substr(from, end - from));
        from = end;
    }
    REQUIRE(frames.size() == 3);
    CHECK(frames[0] == get(server.port(), at + "/image?width=64&height=48&format=png").body);
    CHECK(frames[1] != frames[0]);
    const Answer drawn =
        post(server.port(), "/v1/render?onerror=image&width=300&height=80", "<world>");
    CHECK(drawn.status == 400);
    const image::Image image = image::decodeImage(drawn.body, "error.png");
    CHECK(image.width == 300);
    CHECK(std::count(image.pixels.begin(), image.pixels.end(), 255) > 300 * 80 + 100);  // letters
}

TEST_CASE("over=time draws one loop of the scene without a seam") {
    RealServer server;
    const auto store = [&](const std::string& xml) {
        return post(server.port(), "/v1/scenes", xml).header("location");
    };
    const std::string box =
        "<models><model file=\"box_2_1.3d\"><color><diffuse R=\"200\" G=\"9\" "
        "B=\"9\"/></color></model></models></group>";
    const std::string turning = world(
        "<group><transform><rotate time=\"8\" x=\"0\" y=\"1\" z=\"0\"/><translate x=\"1\" y=\"0\" "
        "z=\"0\"/></transform>" +
        box);
    const std::string at = store(turning), size = "&width=64&height=48";
    const auto imageAt = [&](double timeS) {
        return get(server.port(), at + "/image?format=png&time=" + std::to_string(timeS) + size)
            .body;
    };
    const auto framesOf = [&](const std::string& query) {
        const Answer parts =
            get(server.port(), at + "/turntable?over=time&format=png" + query + size);
        REQUIRE(parts.status == 200);
        std::vector<std::string> frames;
        for (std::size_t from = 0;
             (from = parts.body.find("\x89PNG", from)) != std::string::npos;) {
            const std::size_t end = parts.body.find("\r\n--farol-frame", from);
            frames.push_back(parts.body.substr(from, end - from));
            from = end;
        }
        return frames;
    };
    const std::vector<std::string> frames = framesOf("&frames=4");
    REQUIRE(frames.size() == 4);
    for (std::size_t i = 0; i < 4; ++i) CHECK(frames[i] == imageAt(2.0 * static_cast<double>(i)));
    CHECK(frames[1] != frames[0]);
    // The frame after the last is the first.
    CHECK(frames[0] == imageAt(8.0));
    CHECK(framesOf("&fps=2").size() == 16);
    CHECK(framesOf("&frames=3&time=1")[0] == imageAt(1.0));
    // The rate is that of the scene's own time: 4 frames in 8 s, 2 s each.
    const Answer animation = get(server.port(), at + "/turntable?over=time&frames=4" + size);
    REQUIRE(animation.status == 200);
    const std::size_t control = animation.body.find("fcTL");
    REQUIRE(control != std::string::npos);
    const auto shortAt = [&](std::size_t offset) {
        return static_cast<unsigned char>(animation.body[control + offset]) * 256 +
               static_cast<unsigned char>(animation.body[control + offset + 1]);
    };
    CHECK(shortAt(24) == 2 * shortAt(26));

    for (const auto& [query, message] : std::vector<std::pair<std::string, std::string>>{
             {"&fps=60", "480 frames"},
             {"&frames=120&width=1024&height=1024", "at most 33554432"}}) {
        const Answer refused = get(server.port(), at + "/turntable?over=time" + query);
        CHECK(refused.status == 400);
        CHECK_THAT(refused.body, Catch::Contains(message));
    }
    const std::string still = store(world("<group>" + box));
    const Answer refused = get(server.port(), still + "/turntable?over=time");
    CHECK(refused.code() == "option.range");
    CHECK_THAT(refused.body, Catch::Contains("nothing moves"));
}

TEST_CASE("a client that goes away ends the drawing of its turntable") {
    RealServer server;
    const std::string at =
        post(server.port(), "/v1/scenes", model("sphere_1_64_64.3d")).header("location");
    const auto countOf = [](long worker::JobCounts::*outcome) {
        const auto jobs = realBackend().state().jobs;
        const auto found = jobs.find("turntable");
        return found == jobs.end() ? 0 : found->second.*outcome;
    };
    const long done = countOf(&worker::JobCounts::done),
               failed = countOf(&worker::JobCounts::failed);
    const auto restarts = realBackend().state().restarts;
    {
        RawClient client(server.port());
        client.send("GET " + at +
                    "/turntable?frames=120&width=512&height=512&aa=16 HTTP/1.1\r\n"
                    "Host: localhost\r\n\r\n");
        while (realBackend().state().busy == 0)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    while (countOf(&worker::JobCounts::done) == done &&
           countOf(&worker::JobCounts::failed) == failed)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    CHECK(countOf(&worker::JobCounts::done) == done);
    CHECK(countOf(&worker::JobCounts::failed) == failed + 1);
    // Its worker goes on.
    CHECK(get(server.port(), at + "/turntable?frames=2&width=16&height=16").status == 200);
    CHECK(realBackend().state().restarts == restarts);
}
