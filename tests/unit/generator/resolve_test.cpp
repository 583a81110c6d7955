#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/unit/generator/checks.h"

using namespace farol;
using checks::words;
using scene::ModelSource;

namespace {

struct Result {
    scene::Scene scene;
    Diagnostics diagnostics;
    const scene::Model& model() const { return scene.groups[0].models[0]; }
    bool has(const std::string& code, Severity severity) const {
        for (const Diagnostic& one : diagnostics)
            if (one.code == code && one.severity == severity) return true;
        return false;
    }
};

struct Setup {
    std::string file, command, comment;
    std::optional<int> revolve = {};
    std::string commentFor = {};
};

const std::map<std::string, std::string> kBundle{
    {"models/Ship.3d", "0 0 0\n1 0 0\n0 1 0\n"},
    {"cone_9_9_9_9.3d", "0 0 0\n1 0 0\n0 1 0\n"},
    {"pawn.ply",
     "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
     "property float z\nend_header\n1 0 0\n1 1 0\n"},
    {"a/twin.3d", "0 0 0\n1 0 0\n0 1 0\n"},
    {"b/twin.3d", "0 0 0\n2 0 0\n0 2 0\n"},
    {"own.patch", "1\n0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0\n1\n0,0,0\n"},
    {"wood.jpg", "x"}};

Result resolved(const Setup& setup) {
    Result out;
    scene::Model model;
    model.file = setup.file;
    model.command = setup.command;
    model.revolve = setup.revolve;
    model.where = {"scene.xml", 7, 3};
    out.scene.groups.emplace_back().models.push_back(model);
    if (!setup.comment.empty())
        out.scene.generatorComments[setup.commentFor.empty() ? setup.file : setup.commentFor] =
            words(setup.comment);
    generator::resolve(out.scene, scene::BundleAssets(kBundle), out.diagnostics);
    return out;
}

}  // namespace

TEST_CASE("models are found in the bundle, in comments, in their names and built in") {
    struct Row {
        Setup setup;
        std::string path, shape, warning;
    };
    for (const Row& row : std::vector<Row>{
             {{"models/Ship.3d", "", ""}, "models/Ship.3d", "", ""},
             {{"Ship.3d", "", ""}, "models/Ship.3d", "", "asset.found-elsewhere"},
             {{"cone_9_9_9_9.3d", "", "cone 1 2 4 3"}, "cone_9_9_9_9.3d", "", ""},
             {{"c.3d", "", "cone 1 2 4 3"}, "", "cone 1 2 4 3", ""},
             {{"models/c.3d", "", "cone 1 2 4 3", {}, "c.3d"}, "", "cone 1 2 4 3", ""},
             {{"box_2_3.3d", "", "2 3"}, "", "box 2 3", ""},
             {{"box_nt.3d", "", "2 3"}, "", "box 2 3", ""},
             {{"bezier.3d", "", "bezier teapot.patch 10"}, "", "patch teapot.patch 10", ""},
             {{"t.3d", "", "patch 10 teapot.patch"}, "", "patch teapot.patch 10", ""},
             {{"sphere.3d", "", "sphere 8 8 1"}, "", "sphere 1 8 8", "shape.order"},
             {{"x.3d", "", "cone 10 10 0.5 2"}, "", "cone 0.5 2 10 10", "shape.order"},
             {{"box_2_3.3d", "", "box two three"}, "", "box 2 3", "shape.argument"},
             {{"Ship.3d", "plane 4", ""}, "models/Ship.3d", "", ""},
             {{"none.3d", "plane 4", ""}, "", "plane 4", ""},
             {{"cone_1_2_4_3.3d", "", ""}, "", "cone 1 2 4 3", ""},
             {{"sphere_0.5_8_8.3d", "", ""}, "", "sphere 0.5 8 8", ""},
             {{"demos/sphere_1_8_8.3d", "", ""}, "", "sphere 1 8 8", ""},
             {{"bezier_10.3d", "", ""}, "", "patch teapot.patch 10", ""},
             {{"teapot.3d", "", ""}, "", "patch teapot.patch", ""},
             {{"teapot.patch", "", ""}, "", "patch teapot.patch", ""},
             {{"own.patch", "", ""}, "own.patch", "patch own.patch", ""},
             {{"bezier_own_2.3d", "", ""}, "own.patch", "patch own.patch 2", ""},
             {{"bezier_teapot_3.3d", "", ""}, "", "patch teapot.patch 3", ""},
             {{"teapot_patch_3.3d", "", ""}, "", "patch teapot.patch 3", ""},
             {{"sphere_1.5_8_8", "", ""}, "", "sphere 1.5 8 8", ""},
             {{"sphere-1-8-8.3d", "", ""}, "", "sphere 1 8 8", ""},
             {{"cone-1-2-8-4.3d", "", ""}, "", "cone 1 2 8 4", ""},
             {{"sphere(1,8,8).3d", "", ""}, "", "sphere 1 8 8", ""},
             {{"sphere_1_8_8 (2).3d", "", ""}, "", "sphere 1 8 8", ""},
             {{"sphere_1_8_8 - Copia.3d", "", ""}, "", "sphere 1 8 8", ""},
             {{"sphere_1_8_8.3d.3d", "", ""}, "", "sphere 1 8 8", ""},
             {{"plane_2", "", ""}, "", "plane 2", ""},
             {{"cube_2.3d", "", ""}, "", "box 2", ""},
             {{"HAT.3D", "", "cone 1 2", {}, "hat.3d"}, "", "cone 1 2", ""},
             {{"t.3d", "", "teapot.patch 3"}, "", "patch teapot.patch 3", ""},
             {{"", "teapot 3", ""}, "", "patch teapot.patch 3", ""},
             {{"", "bezier teapot 3", ""}, "", "patch teapot.patch 3", ""},
             {{"", "generator sphere 1", ""}, "", "sphere 1", ""},
             {{"torus.3d", "", ""}, "", "torus 1 0.5", "shape.guessed"},
             {{"plane.3d", "", ""}, "", "plane 1", "shape.guessed"},
             {{"", "plane 4", ""}, "", "plane 4", ""},
             {{"", "Box 1 2 3", ""}, "", "box 1 2 3", ""},
             {{"", "revolution pawn.ply 32", ""}, "pawn.ply", "revolution pawn.ply 32", ""},
             {{"pawn.ply", "", "", 9}, "pawn.ply", "revolution pawn.ply 9", ""}}) {
        CAPTURE(row.setup.file, row.setup.command, row.setup.comment);
        const Result result = resolved(row.setup);
        for (const Diagnostic& one : result.diagnostics) {
            CAPTURE(one.message);
            CHECK(one.severity != Severity::error);
            CHECK(one.where == Location{"scene.xml", 7, 3});
        }
        const ModelSource& source = result.model().source;
        const bool file = row.shape.empty();
        CHECK(source.kind == (file ? ModelSource::Kind::file : ModelSource::Kind::shape));
        CHECK(source.path == row.path);
        if (!file) CHECK(generator::textOf(source.shape) == row.shape);
        if (!row.warning.empty()) CHECK(result.has(row.warning, Severity::warning));
        const bool patchFile = row.setup.file == "own.patch";
        CHECK(
            result.has(file || patchFile ? "asset.from-file" : "asset.generated", Severity::info));
        if (row.path != "own.patch")  // which has no area
            CHECK(generator::load(result.model(), scene::BundleAssets(kBundle)).triangles() > 0);
    }
}

TEST_CASE("models that are neither file nor shape are errors at their place") {
    struct Row {
        Setup setup;
        std::string code, said;
    };
    for (const Row& row : std::vector<Row>{
             {{"shpere_1_8_8.3d", "", ""}, "asset.missing", "did you mean \"sphere_1_8_8.3d\""},
             {{"modles/Shipp.3d", "", ""}, "asset.missing", "did you mean \"Ship.3d\""},
             {{"twin.3d", "", ""}, "asset.missing", "twin.3d"},
             {{"box_nt.3d", "", ""}, "asset.missing", "box_nt.3d"},
             {{"box", "", ""}, "asset.missing", "box"},
             {{"bezier_comet_2.3d", "", ""}, "asset.missing", "comet.patch"},
             {{"../../etc/passwd", "", ""}, "asset.missing", "passwd"},
             {{"sphere_1_2_8.3d", "", ""}, "shape.argument", "SLICES"},
             {{"c.3d", "", "cone 1 2 4"}, "", ""},
             {{"c.3d", "", "cone 1 -2 4 3"}, "shape.argument", "HEIGHT"},
             {{"c.3d", "", "coen 1 2 4 3"}, "shape.unknown", "did you mean \"cone\""},
             {{"c.3d", "", "patch missing.patch 3"}, "asset.missing", "missing.patch"},
             {{"", "sphere", ""}, "shape.argument", "RADIUS"},
             {{"", "sphere 1 90000 90000", ""}, "limit.triangles", "5000000"},
             {{"none.ply", "", "", 8}, "asset.missing", "none.ply"},
             {{"pawn.ply", "", "", 2}, "shape.argument", "N"}}) {
        CAPTURE(row.setup.file, row.setup.command, row.setup.comment);
        const Result result = resolved(row.setup);
        if (row.code.empty()) {  // fewer arguments than counts: the rest is chosen
            CHECK(result.model().source.kind == ModelSource::Kind::shape);
            continue;
        }
        CHECK(result.model().source.kind == ModelSource::Kind::none);
        bool found = false;
        for (const Diagnostic& one : result.diagnostics) {
            if (one.severity != Severity::error) continue;
            found = true;
            CHECK(one.code == row.code);
            CHECK_THAT(one.message, Catch::Contains(row.said));
            CHECK(one.where == Location{"scene.xml", 7, 3});
        }
        CHECK(found);
        CHECK_THROWS_AS(generator::load(result.model(), scene::BundleAssets(kBundle)), Error);
    }
}

TEST_CASE("textures, background and skybox are found or reported, also in the entity") {
    scene::Scene main;
    scene::Texture wood, lost, chess;
    wood.file = "textures/wood.jpg";
    lost.file = "woood.jpg";
    chess.chess = scene::Chess{};
    for (const auto& texture : {wood, lost, chess, lost}) {
        scene::Model model;
        model.command = "plane 1";
        model.texture = texture;
        model.texture->where.line = 4;
        main.groups.emplace_back().groups.emplace_back().models.push_back(model);
    }
    main.background.file = "none.png";
    main.skybox = scene::Skybox{"sky.png", "", 500, {}};
    main.entity = std::make_shared<scene::Scene>();
    main.entity->background.file = "wood.jpg";
    Diagnostics diagnostics;
    generator::resolve(main, scene::BundleAssets(kBundle), diagnostics);
    CHECK(main.groups[0].groups[0].models[0].texture->path == "wood.jpg");
    CHECK(main.groups[1].groups[0].models[0].texture->path.empty());
    CHECK(main.entity->background.path == "wood.jpg");
    int missing = 0;
    for (const Diagnostic& one : diagnostics) missing += one.code == "asset.missing" ? 1 : 0;
    CHECK(missing == 4);  // woood.jpg twice, none.png, sky.png
}

TEST_CASE("messages quote a bounded part of a file's name") {
    try {
        generator::generate(generator::parseCall({"patch", std::string(10'000, 'x') + ".patch"}),
                            scene::BundleAssets());
        FAIL("was found");
    } catch (const Error& error) {
        CHECK(error.code() == "asset.missing");
        CHECK(std::string(error.what()).size() < 200);
    }
}

TEST_CASE("messages about file names that students write") {
    struct Row {
        const char *file, *code, *message;
    };
    const Row rows[] = {
        {"models\\ship.3d", "asset.case",
         "\"models\\ship.3d\" is the file \"models/Ship.3d\"; write capital and small letters as "
         "in the "
         "file's name"},
        {"C:\\Users\\ana\\ship.3d", "asset.case",
         "\"C:\\Users\\ana\\ship.3d\" is the file \"models/Ship.3d\"; write capital and small "
         "letters as in the "
         "file's name"},
        {"../scenes/ship.3d", "asset.case",
         "\"../scenes/ship.3d\" is the file \"models/Ship.3d\"; write capital and small letters as "
         "in the "
         "file's name"},
        {"spaceship.3d", "asset.missing",
         "there is no file \"spaceship.3d\", no generator comment for it, and its name is not that "
         "of a shape; add it to the scene's files, or correct the name"},
        {"shpi.3d", "asset.missing",
         "there is no file \"shpi.3d\", no generator comment for it, and its name is not that of a "
         "shape; did you mean \"Ship.3d\"?"},
        {"spere_1_8_8.3d", "asset.missing",
         "there is no file \"spere_1_8_8.3d\", no generator comment for it, and its name is not "
         "that of a shape; did you mean \"sphere_1_8_8.3d\"?"},
        {"sphere_0,5_8_8.3d", "asset.missing",
         "there is no file \"sphere_0,5_8_8.3d\", no generator comment for it, and its name is not "
         "that of a shape; write a point for the comma: \"sphere_0.5_8_8.3d\""},
        {"sphere_1_-8_8.3d", "shape.argument",
         "the argument SLICES of sphere is \"-8\"; expected a whole number in 3 to 100000; usage: "
         "sphere RADIUS [SLICES] [STACKS]"},
        {"box_2_0.3d", "shape.argument",
         "the argument DIV of box is \"0\"; expected a whole number in 1 to 100000; usage: box X "
         "[DIV], or box X Y Z [DIV]"},
        {"sphere.3d", "shape.guessed",
         "\"sphere.3d\" does not exist and its name gives no size; using \"sphere 1\""},
    };
    for (const Row& row : rows) {
        CAPTURE(row.file);
        const Result found = resolved({row.file, "", ""});
        REQUIRE_FALSE(found.diagnostics.empty());
        CHECK(found.diagnostics[0].code == row.code);
        CHECK(found.diagnostics[0].message == row.message);
        CHECK(found.diagnostics[0].where.line == 7);
    }
}

TEST_CASE("a mesh of an unknown form is the shape that its name or comment says") {
    const std::string unknown = "PLANE\nLength: 2\nVERTICES:\n(0.0, 0.0, 0.0)\n";
    const scene::BundleAssets bundle({{"plane_2_3.3d", unknown},
                                      {"floor.3d", unknown},
                                      {"thing.3d", unknown},
                                      {"box_1.3d", "0 0 0\n1 0 0\n0 1 0\n"},
                                      {"plane_9.obj", "v 0 0 0\n"}});
    struct Row {
        std::string file, comment;
        std::size_t triangles;  ///< 0: refused
    };
    for (const Row& row : std::vector<Row>{{"plane_2_3.3d", "", 18},
                                           {"floor.3d", "plane 2 4", 32},
                                           {"plane_2_3.3d", "box 2", 12},
                                           {"thing.3d", "", 0},
                                           {"plane_9.obj", "", 0}}) {
        CAPTURE(row.file, row.comment);
        scene::Scene scene;
        scene.groups.emplace_back().models.emplace_back().file = row.file;
        if (!row.comment.empty()) scene.generatorComments[row.file] = words(row.comment);
        Diagnostics diagnostics, findings;
        generator::resolve(scene, bundle, diagnostics);
        const scene::Model& model = scene.groups[0].models[0];
        if (row.triangles == 0) {
            CHECK_THROWS_AS(generator::load(model, bundle, &findings), Error);
            continue;
        }
        CHECK(generator::load(model, bundle, &findings).triangles() == row.triangles);
        REQUIRE(findings.size() == 1);
        CHECK(findings[0].code == "mesh.replaced");
        CHECK(findings[0].where.file == row.file);
        CHECK(findings[0].where.line == 4);
    }
    // A readable file is read, whatever its name says.
    scene::Scene scene;
    scene.groups.emplace_back().models.emplace_back().file = "box_1.3d";
    Diagnostics diagnostics, findings;
    generator::resolve(scene, bundle, diagnostics);
    CHECK(generator::load(scene.groups[0].models[0], bundle, &findings).triangles() == 1);
    CHECK(findings.empty());
}

TEST_CASE("the materials of an OBJ file are found beside it, with their textures") {
    const std::string obj = "mtllib my box.mtl\nv 0 0 0\nusemtl a\n";
    const scene::BundleAssets bundle(
        {{"models/box.obj", obj},
         {"models/my box.mtl",
          "newmtl a\nKd 1 0 0\nmap_Kd skin.png\nnewmtl b\nmap_Kd far.png\n"
          "newmtl c\nmap_Kd none.png\n"},
         {"my box.mtl", "newmtl wrong\n"},
         {"models/skin.png", "x"},
         {"skin.png", "x"},
         {"textures/far.png", "x"},
         {"lost.obj", "mtllib lost.mtl\nv 0 0 0\n"},
         {"plain.obj", "v 0 0 0\n"}});
    const auto find = [&bundle](const std::string& file, Diagnostics& diagnostics) {
        scene::Scene scene;
        scene.groups.emplace_back().models.emplace_back().file = file;
        generator::resolve(scene, bundle, diagnostics);
        return scene.groups[0].models[0].source.materials;
    };
    Diagnostics diagnostics;
    const auto materials = find("models/box.obj", diagnostics);
    REQUIRE(materials);
    REQUIRE(materials->size() == 3);
    CHECK((*materials)[0].name == "a");
    CHECK((*materials)[0].texture->path == "models/skin.png");
    CHECK((*materials)[1].texture->path == "textures/far.png");
    CHECK_FALSE((*materials)[2].texture);
    const auto count = [](const Diagnostics& all) {
        return std::count_if(all.begin(), all.end(),
                             [](const Diagnostic& one) { return one.code == "mesh.material"; });
    };
    CHECK(count(diagnostics) == 1);
    Diagnostics lost, plain;
    CHECK_FALSE(find("lost.obj", lost));
    CHECK(count(lost) == 1);
    CHECK_FALSE(find("plain.obj", plain));
    CHECK(count(plain) == 0);
}

TEST_CASE("shape words of this course's students, in any order that their generators write") {
    struct Row {
        const char* comment;
        const char* shape;
    };
    const Row row = GENERATE(values<Row>({{"anel 1 2 24", "ring 1 2 24"},
                                          {"cubo 2", "box 2"},
                                          {"caixa 2 3", "box 2 3"},
                                          {"caja 2 3", "box 2 3"},
                                          {"esfera 1 16 8", "sphere 1 16 8"},
                                          {"plano 2 3", "plane 2 3"},
                                          {"cone 1 2 4 3", "cone 1 2 4 3"},
                                          {"cono 1 2 4 3", "cone 1 2 4 3"},
                                          {"cilindro 1 2", "cylinder 1 2"},
                                          {"toro 3 1", "torus 3 1"},
                                          {"anillo 1 2", "ring 1 2"},
                                          {"Esfera 1", "sphere 1"}}));
    CAPTURE(row.comment);
    const Result result = resolved({"a.3d", "", row.comment});
    CHECK(generator::textOf(result.model().source.shape) == row.shape);
    CHECK_FALSE(result.has("shape.argument", Severity::warning));
}

TEST_CASE("lengths in GLUT's order and surplus numbers are read with a warning") {
    struct Row {
        const char* file;
        const char* shape;
    };
    const Row row = GENERATE(values<Row>({{"torus_1_3_24_12.3d", "torus 3 1 24 12"},
                                          {"torus_1_3.3d", "torus 3 1"},
                                          {"ring_2_1_24.3d", "ring 1 2 24"},
                                          {"ring_1_2_24_24.3d", "ring 1 2 24"},
                                          {"sphere_1_16_8_5_6.3d", "sphere 1 16 8"},
                                          {"esfera_1_16_8.3d", "sphere 1 16 8"}}));
    CAPTURE(row.file);
    const Result result = resolved({row.file, "", ""});
    CHECK(generator::textOf(result.model().source.shape) == row.shape);
    CHECK(result.has("shape.argument", Severity::warning) ==
          (std::string(row.file).find("esfera") == std::string::npos));
}
