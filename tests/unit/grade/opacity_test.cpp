// Causes of another opacity, of other transparent parts of textures, and of transparency off.
#include <algorithm>
#include <catch2/catch.hpp>

#include "core/language.h"
#include "grade/rubric/grader.h"
#include "image/format.h"
#include "scene/files/assets.h"

using namespace farol;

namespace {

using Files = std::map<std::string, std::string>;

/// A leaf: opaque within an ellipse whose middle is `aside` px right of the image's.
std::string leaf(int aside, std::uint8_t outside = 0, std::uint8_t green = 150) {
    constexpr int kSide = 64;
    image::Image image{kSide, kSide, {}};
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const double u = (x + 0.5 - kSide / 2 - aside) / 20.0, v = (y + 0.5 - kSide / 2) / 28.0;
            const bool isLeaf = u * u + v * v < 1.0;
            const std::uint8_t texel[] = {static_cast<std::uint8_t>(isLeaf ? 40 : 0),
                                          static_cast<std::uint8_t>(isLeaf ? green : 0), 30,
                                          isLeaf ? std::uint8_t{255} : outside};
            image.pixels.insert(image.pixels.end(), texel, texel + 4);
        }
    return image::encodePng(image);
}

/// A box of glass before a leaf on a card; line 7 is the box, line 9 the leaf's texture.
std::string sceneXml(const std::string& glass, const std::string& render = "<render/>") {
    return R"(<world><camera><position x="0" y="0" z="7"/><lookAt x="0" y="0" z="0"/></camera>
<lights><light type="directional" dirx="1" diry="2" dirz="3"/></lights>
)" + render +
           R"(
<group><models><model file="box_3_1.3d"><color><diffuse R="40" G="40" B="200"/></color></model></models></group>
<group><transform><translate x="-0.6" y="0" z="3"/></transform><models>
<!-- -->
<model file="box_1_1.3d" )" +
           glass + R"(><color><diffuse R="220" G="220" B="60"/></color></model></models></group>
<group><transform><translate x="0.8" y="0" z="2.5"/><rotate angle="90" x="1" y="0" z="0"/></transform><models><model file="plane_1.5_1.3d" twoSided="true">
<texture file="leaf.png"/></model></models></group></world>)";
}

grade::Grade gradeOf(const std::string& reference, const std::string& xml,
                     const Files& files = {{"leaf.png", leaf(0)}}) {
    static render::Renderer renderer;
    static grade::Grader grader(renderer);
    const auto subject = [](const std::string& document, const Files& with) {
        grade::Subject made;
        made.job.name = "scene.xml";
        made.job.xml = document;
        made.job.assets = std::make_shared<scene::BundleAssets>(with);
        return made;
    };
    grade::Rubric rubric = grade::defaultRubric();
    rubric.reveal = grade::Reveal::values;
    return grader.grade(subject(reference, {{"leaf.png", leaf(0)}}), subject(xml, files), rubric);
}

const grade::GradedCause& onlyCause(const grade::Grade& grade) {
    REQUIRE(grade.causes.size() == 1);
    CHECK(grade.causes[0].isSeen);
    CHECK(grade.causes[0].points > 0.0);
    CHECK(grade.points < grade.most);
    CHECK(grade.points > 0.6 * grade.most);
    return grade.causes[0];
}

const std::string kGlass = sceneXml(R"(opacity="0.4")");

}  // namespace

TEST_CASE("another opacity is a cause, with its line and both values") {
    CHECK(gradeOf(kGlass, kGlass).causes.empty());
    struct Row {
        const char *expected, *given, *words;
    };
    for (const Row& row :
         {Row{R"(opacity="0.4")", "", "it is opaque, and should be transparent"},
          Row{R"(opacity="0.4")", R"(opacity="0.8")", "opacity is too large"},
          Row{R"(opacity="0.6")", R"(opacity="0.2")", "opacity is too small"},
          Row{"", R"(opacity="0.4")", "it is transparent, and should be opaque"}}) {
        INFO(row.given);
        const grade::Grade grade = gradeOf(sceneXml(row.expected), sceneXml(row.given));
        const grade::GradedCause& cause = onlyCause(grade);
        CHECK(cause.code == "material.opacity");
        CHECK_THAT(cause.message.text, Catch::Contains(row.words));
        CHECK(cause.places[0].where.line == 7);
    }
    CHECK_THAT(gradeOf(kGlass, sceneXml(R"(opacity="0.8")")).causes[0].message.text,
               Catch::Contains("0.8") && Catch::Contains("0.4"));
}

TEST_CASE("the opacity of a material and of its model are one") {
    std::string byColor = sceneXml("");
    byColor.replace(byColor.find(R"(G="220")"), 7, R"(G="220" A="0.4")");
    const grade::Grade grade = gradeOf(kGlass, byColor);
    CHECK(grade.causes.empty());
    CHECK(grade.points == grade.most);
}

TEST_CASE("other transparent parts of a texture are a cause") {
    struct Row {
        std::string file;
        const char* words;
    };
    for (const Row& row : {Row{leaf(0, 255), "no transparent parts, and should have some"},
                           Row{leaf(9), "different transparent parts"}}) {
        const grade::Grade grade = gradeOf(kGlass, kGlass, {{"leaf.png", row.file}});
        const grade::GradedCause& cause = onlyCause(grade);
        CHECK(cause.code == "texture.alpha");
        CHECK_THAT(cause.message.text, Catch::Contains(row.words));
        CHECK(cause.places[0].where.line == 9);
    }
    // Colours that nobody sees do not differ; those of the leaf do.
    CHECK(onlyCause(gradeOf(kGlass, kGlass, {{"leaf.png", leaf(0, 0, 250)}})).code ==
          "texture.wrong");
}

TEST_CASE("transparency that is off is one cause for the scene") {
    const std::string opaque = sceneXml(R"(opacity="0.4")", R"(<render transparency="off"/>)");
    const grade::Grade off = gradeOf(kGlass, opaque);
    const grade::GradedCause& cause = onlyCause(off);
    CHECK(cause.code == "transparency.mode");
    CHECK_THAT(cause.message.text, Catch::Contains("transparency is off"));
    // The other way round; and opacities that the reference does not show are none.
    const grade::Grade on = gradeOf(opaque, kGlass);
    CHECK(onlyCause(on).code == "transparency.mode");
    // The places are those of the attribute, and of the root where it is absent.
    const auto lineOf = [](const std::string& document, std::string_view part) {
        const std::size_t at = document.find(part);
        REQUIRE(at != std::string::npos);
        return 1 + std::count(document.begin(), document.begin() + static_cast<long>(at), '\n');
    };
    REQUIRE(cause.places.size() == 1);
    CHECK(cause.places[0].where.line == lineOf(opaque, "transparency=\"off\""));
    CHECK(cause.places[0].where.line > 1);
    REQUIRE(onlyCause(on).places.size() == 1);
    CHECK(onlyCause(on).places[0].where.line == lineOf(kGlass, "<world"));
    CHECK(gradeOf(opaque, sceneXml("", R"(<render transparency="off"/>)")).causes.empty());
    CHECK(gradeOf(kGlass, sceneXml(R"(opacity="0.4")", R"(<render transparency="exact"/>)"))
              .causes.empty());
}

TEST_CASE("causes of opacity are worded in each language") {
    const grade::Grade grade = gradeOf(kGlass, sceneXml(""));
    const grade::GradedCause& cause = onlyCause(grade);
    CHECK_THAT(grade::textIn(Language::pt, cause),
               Catch::Contains("é opaco e devia ser transparente"));
    CHECK_THAT(grade::textIn(Language::es, cause),
               Catch::Contains("es opaco y debería ser transparente"));
    CHECK_THAT(grade::textIn(Language::cs, cause),
               Catch::Contains("je neprůhledné, má být průhledné"));
}
