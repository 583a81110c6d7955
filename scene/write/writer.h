#pragma once

#include <string>

#include "core/enum_words.h"
#include "scene/scene.h"

namespace farol::scene {

/// Ways to write a scene: every element and attribute that Farol reads, or the words of one
/// dialect alone.
enum class Form { canonical, course, engine2017, engine2020 };
inline constexpr EnumWords<Form, Form::engine2020> kFormWords{"canonical", "course", "2017",
                                                              "2020"};

/// Returns the scene as XML. Canonical: every element is spelt one way, included files are in
/// place, colours by value; reading it back gives an equal scene. Other forms leave out the
/// features that their dialect lacks: interchange::adapt replaces those that it can. Results of
/// the resolver are not written. An entity is written as the name of its file.
std::string write(const Scene& scene, Form form = Form::canonical);

}  // namespace farol::scene
