#include "tests/fuzz/scene_words.h"

#include <set>

#include "scene/read/tables.h"

namespace farol::fuzz {
namespace {

/// The words of a row, which blanks and bars part.
void addWords(std::string_view words, std::set<std::string>& out) {
    while (!words.empty()) {
        const std::size_t end = words.find_first_of(" |");
        if (end != 0) out.emplace(words.substr(0, end));
        words.remove_prefix(end == std::string_view::npos ? words.size() : end + 1);
    }
}

std::vector<std::string> makeTokens() {
    std::vector<std::string> tokens = {"<!--",
                                       "-->",
                                       "<![CDATA[",
                                       "]]>",
                                       "<?xml version=\"1.0\"?>",
                                       "<!DOCTYPE",
                                       "&amp;",
                                       "&#0;",
                                       "&#x110000;",
                                       "&lol;",
                                       "\"",
                                       "'",
                                       "=",
                                       "/>",
                                       ">",
                                       "<",
                                       "</",
                                       "<group>",
                                       "</group>",
                                       "<models>",
                                       "<a b='",
                                       "chess:8x8",
                                       "chess:0x-1",
                                       "rgb",
                                       "#ff8800",
                                       "1,2,3",
                                       "1 2 3 4",
                                       "1..7",
                                       "auto",
                                       "scene.xml",
                                       "part.xml",
                                       "ship.xml",
                                       "a.3d",
                                       "p.ply",
                                       "t.patch",
                                       "t.png",
                                       "../a.3d",
                                       "/etc/passwd",
                                       "C:\\a.3d",
                                       "cone_1_2_4_3.3d",
                                       "bezier_10.3d",
                                       "<!-- generator cone 1 2 4 3 b.3d -->",
                                       "generator",
                                       "\xEF\xBB\xBF",
                                       "\xFF\xFE",
                                       "\xC3\x28",
                                       "\xED\xA0\x80",
                                       "revolution p.ply 32",
                                       "cone 1 2 4 3",
                                       "<include file='part.xml'/>",
                                       "<xmls><xml file='part.xml'/></xmls>",
                                       "<light type='point'/>",
                                       "<translate time='1' align='true'>",
                                       "<point x='1'/>"};
    std::set<std::string> words;
    for (const scene::ElementSpec& element : scene::elementSpecs()) {
        std::set<std::string> names{std::string(element.name)};
        addWords(element.aliases, names);
        for (const std::string& name : names) {
            words.insert(name);
            words.insert("<" + name + ">");
            words.insert("</" + name + ">");
            words.insert("<" + name + "/>");
        }
        for (const scene::AttributeSpec& attribute : element.attributes) {
            std::set<std::string> spellings{std::string(attribute.name)};
            addWords(attribute.aliases, spellings);
            for (const std::string& name : spellings) words.insert(" " + name + "=\"1\"");
            addWords(attribute.words, words);
        }
    }
    tokens.insert(tokens.end(), words.begin(), words.end());
    return tokens;
}

}  // namespace

const std::vector<std::string>& sceneTokens() {
    static const std::vector<std::string> tokens = makeTokens();
    return tokens;
}

scene::BundleAssets sceneBundle(std::string_view xml) {
    return scene::BundleAssets({
        {kSceneName, std::string(xml)},
        {"part.xml", "<scene><group><models><model file='a.3d'/></models></group></scene>"},
        {"sub/cycle.xml",
         "<scene><xmls><xml file='../scene.xml'/><xml file='scene.xml'/>"
         "<xml file='cycle.xml'/></xmls></scene>"},
        {"ship.xml", "<scene><models><model file='cone_1_2_4_3.3d'/></models></scene>"},
        {"a.3d", "0 0 0\n1 0 0\n0 1 0\n\n0 1 2\n"},
        {"sub/b.3d", "0 0 0\n1 0 0\n0 1 0\n"},
        {"B.3d", "0 0 0\n1 0 0\n0 1 0\n"},
        {"p.ply", "1 0 0\n1 1 0\n"},
        {"t.patch",
         "1\n0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15\n16\n0,0,0\n1,0,0\n2,0,0\n3,0,0\n0,1,0\n1,1,0\n"
         "2,1,0\n3,1,0\n0,2,0\n1,2,0\n2,2,0\n3,2,0\n0,3,0\n1,3,0\n2,3,0\n3,3,0\n"},
        {"t.png", "no picture: nobody decodes it here"},
    });
}

}  // namespace farol::fuzz
