#pragma once

#include "server/backend.h"

/// Pictures that are more than one frame of a scene, or less.
namespace farol::server::worker {

/// The frames of a turn, from the job's own camera on. Throws as Renderer::render does.
render::Picture turnAround(render::Renderer& renderer, const render::Job& job,
                           const Turntable& turn);

/// The text in lines on a dark ground, as large as the options say (480 x 270 px where they do
/// not).
render::Picture drawNotice(const std::string& text, const render::PictureOptions& options);

}  // namespace farol::server::worker
