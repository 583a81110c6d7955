#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "server/backend.h"

/// What the service and its workers say to each other.
namespace farol::server::worker {

enum class Task { render, inspect, mesh, unpack, turntable, notice, grade, compare, check };

struct Request {
    Task task = Task::check;
    render::Job job;  ///< of render and inspect; of unpack, its archive; of grade: the submission
    MeshJob mesh;
    Turntable turntable;
    std::string notice;  ///< the text; its picture is by the job's options
    GradeJob grade;      ///< but for the submission's job
    CompareJob compare;
};

/// A served folder travels by its path, which the worker may read; a bundle by its files.
std::string pack(const Request& request);
/// Throws WireError.
Request unpackRequest(std::string_view bytes);

/// How a job ended.
enum class Outcome {
    done,
    refused,  ///< Error: the caller's fault
    broken,   ///< any other exception
    memory    ///< the worker's memory did not suffice
};

struct Reply {
    Outcome outcome = Outcome::done;
    Diagnostics diagnostics;  ///< of a refusal
    std::string message;      ///< of a fault
    render::Picture picture;
    render::SceneReport report;
    std::string mesh;
    scene::Bundle bundle;  ///< of unpack
    GradeReply grade;
    CompareReply compare;
};

std::string pack(const Reply& reply);
/// Throws WireError.
Reply unpackReply(std::string_view bytes);

/// What a worker says of itself once it can draw.
struct Hello {
    std::string fault;  ///< why it cannot, else empty
    std::string gl;
    Layers sandbox;
};

std::string pack(const Hello& hello);
/// Throws WireError.
Hello unpackHello(std::string_view bytes);

}  // namespace farol::server::worker
