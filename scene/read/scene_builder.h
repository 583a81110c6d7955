#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "scene/files/locator.h"
#include "scene/read/reader.h"
#include "scene/read/values.h"
#include "scene/repair/document.h"
#include "scene/scene.h"

namespace farol::scene {

/// The colour and the opacity of a <color> without a model.
struct GroupColor {
    Color color;
    float opacity = 1.0F;
};

/// State that a document shares with those that it includes.
struct ReadSession {
    const ReadOptions& options;
    const Assets& assets;
    Locator& locator;
    Findings& findings;
    std::vector<std::string> files;  ///< being read now, outermost first
    int elementsLeft = 0;
    int includesLeft = 64;
    std::uint64_t scatters = 0;
    std::optional<GroupColor> groupColor = {};  ///< of the group that is read, or round it
    bool usesGroupColor = false, hasOwnColors = false;
};

/// Reads one document into a Scene: dialect, then elements by their tables. Faults go to the
/// session's findings; damaged elements and attributes keep their defaults.
class SceneBuilder {
  public:
    SceneBuilder(const Document& document, ReadSession& session);
    Scene build();

  private:
    /// The content of a group so far: the order matters to the older dialects.
    struct GroupState {
        std::set<std::string_view> transforms;
        bool transform = false, models = false, lights = false, content = false, isRoot = false;
    };
    using RootReader = void (SceneBuilder::*)(pugi::xml_node);

    // Root elements (build_root.cpp).
    void refuseForeign(pugi::xml_node root, Message text);
    void rootAttributes(pugi::xml_node root);
    bool rootElement(std::string_view canonical, pugi::xml_node element);
    void window(pugi::xml_node element);
    void camera(pugi::xml_node element);
    bool checkCamera(const Camera& camera, const Location& up, const Location& range);
    void colors(pugi::xml_node element);
    void skybox(pugi::xml_node element);
    void background(pugi::xml_node element);
    void entity(pugi::xml_node element);
    void render(pugi::xml_node element);
    void title(pugi::xml_node element);
    void description(pugi::xml_node element);
    std::string bounded(std::string_view text, std::size_t longest, const Location& where,
                        std::string_view element);

    // Includes (build_include.cpp).
    void includes(pugi::xml_node element, Group& group, bool isRoot);
    void includeInto(pugi::xml_node element, Group& group, bool isRoot);
    std::optional<Scene> include(pugi::xml_node element, std::string& file);

    // Groups and transforms (build_group.cpp).
    void groupContent(pugi::xml_node element, const ElementSpec& spec, Group& group,
                      GroupState& state);
    void groupElement(std::string_view canonical, pugi::xml_node element, Group& group,
                      GroupState& state);
    void transforms(pugi::xml_node element, Group& group, GroupState& state);
    void transform(std::string_view canonical, pugi::xml_node element, Group& group,
                   GroupState& state);
    bool transformAllowed(std::string_view canonical, pugi::xml_node element, GroupState& state);
    std::optional<Transform> translate(pugi::xml_node element);
    std::optional<Transform> curve(pugi::xml_node element, const Values& values);
    std::optional<Transform> rotate(pugi::xml_node element);
    std::optional<Transform> scaling(pugi::xml_node element);
    void models(pugi::xml_node element, Group& group, GroupState& state);
    void scatter(pugi::xml_node element, Group& group);
    void warnIfRadians(const Values& values, std::string_view angle, std::string_view element);
    void warnIfSwapped(const Values& values, std::string_view least, std::string_view most);

    // Lights (build_light.cpp).
    void lights(pugi::xml_node element, Group& group, GroupState& state);
    void light(pugi::xml_node element, Group& group);
    void lightDirection(pugi::xml_node element, const Values& values, Light& light, bool typed);
    void lightAttenuation(pugi::xml_node element, const Values& values, Light& light);

    // Models (build_model.cpp).
    void model(pugi::xml_node element, Group& group);
    void modelChildren(pugi::xml_node element, Model& model);
    void texture(pugi::xml_node element, Model& model);
    void texgen(pugi::xml_node element, bool textured, Model& model);
    void generatorElement(pugi::xml_node element, Model& model);
    void setTextureFile(const std::string& file, const Location& where, Texture& texture);
    void modelMaterial(const Values& values, Model& model);
    void colorElement(pugi::xml_node element, Model& model);

    // Colours (build_color.cpp).
    Material& materialOf(Model& model) const;
    void groupColor(pugi::xml_node element);
    bool straightColor(const Values& values, Color& color);
    /// Opacity 0..1 of an attribute: 0 to 1, or 0 to 255 where it is over 1.
    static float opacityOf(double value) {
        return static_cast<float>(value > 1.0 ? std::fmin(value / 255.0, 1.0) : value);
    }
    void colorPart(pugi::xml_node element, const ElementSpec& spec, Color& color,
                   float* opacity = nullptr);
    bool colorAttributes(const Values& values, std::string_view prefix, Color& color);
    bool namedColor(const Values& values, std::string_view attribute, Color& color,
                    float* opacity = nullptr);
    std::optional<Color> colorText(std::string_view text) const;
    std::optional<Color> looseColor(std::string_view text, std::string& reading,
                                    float& opacity) const;

    Values values(pugi::xml_node element, const ElementSpec& spec,
                  Unknown unknown = Unknown::warning);
    Values values(pugi::xml_node element, std::string_view canonical,
                  Unknown unknown = Unknown::warning);
    /// Calls `each(canonical, child)` for the known children and reports the others.
    template <class Each>
    void children(pugi::xml_node element, const ElementSpec& spec, Each each);
    template <class Each>
    void misplacedChildren(pugi::xml_node element, const ElementSpec& spec,
                           std::vector<const ElementSpec*>& open, Each each);
    void unknownChild(pugi::xml_node child, const ElementSpec& parent);
    /// Warns where `canonical` is in `seen` already; for elements allowed once in their parent.
    void onlyOnce(std::string_view canonical, pugi::xml_node child,
                  std::set<std::string_view>& seen);
    Location at(pugi::xml_node element) const { return document_.at(element); }
    Findings& findings() { return session_.findings; }
    /// The dialects whose groups have a fixed order.
    bool isOrdered() const { return scene_.dialect != Dialect::course; }

    const Document& document_;
    ReadSession& session_;
    Scene scene_;
    std::map<std::string, Color> colors_;
    std::map<std::string, float> opacities_;  ///< of those of colors_ that are not opaque
    std::set<std::string_view> rootSeen_;
    bool trackingNoted_ = false;
    int lightCount_ = 0;
};

/// Which dialect a document is written in; an info scene.dialect where its signs disagree. The
/// root's attribute "dialect" wins and is read elsewhere.
Dialect detectDialect(const Document& document, Findings& findings);

/// Reads `xml` and its includes as one scene, without the defaults of a whole scene.
Scene readDocument(std::string_view xml, const std::string& name, ReadSession& session);

template <class Each>
void SceneBuilder::children(pugi::xml_node element, const ElementSpec& spec, Each each) {
    for (const pugi::xml_node child : element.children()) {
        if (child.type() != pugi::node_element) continue;
        const ElementSpec* known = findChild(spec, child.name());
        if (known == nullptr) {
            unknownChild(child, spec);
            continue;
        }
        each(known->name, child);
        if (session_.options.leaveOut && findings().torn()) {
            std::vector<const ElementSpec*> open{known};
            misplacedChildren(child, spec, open, each);
        }
    }
}

/// Reads the content of an element that was not closed: elements below `element` that `spec` allows
/// and none of the elements `open` between allows.
template <class Each>
void SceneBuilder::misplacedChildren(pugi::xml_node element, const ElementSpec& spec,
                                     std::vector<const ElementSpec*>& open, Each each) {
    for (const pugi::xml_node child : element.children()) {
        if (child.type() != pugi::node_element) continue;
        if (const ElementSpec* inner = findChild(*open.back(), child.name())) {
            open.push_back(inner);
            misplacedChildren(child, spec, open, each);
            open.pop_back();
            continue;
        }
        const bool isTaken = std::any_of(open.begin(), open.end(), [&](const ElementSpec* one) {
            return findChild(*one, child.name()) != nullptr;
        });
        const ElementSpec* known = isTaken ? nullptr : findChild(spec, child.name());
        if (known == nullptr) continue;
        each(known->name, child);
        std::vector<const ElementSpec*> inside{known};
        misplacedChildren(child, spec, inside, each);
    }
}

}  // namespace farol::scene
