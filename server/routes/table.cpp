#include "server/routes/table.h"

// A line is all that a route needs beside its handler's file: it declares the handler,
// http::Response HANDLER(Context&, const Call&), and puts it into the table.
#define FAROL_ROUTES(ROUTE)                                                     \
    ROUTE("GET", "/", getPage, kPlain)                                          \
    ROUTE("GET", "/embed", getEmbed, kPlain)                                    \
    ROUTE("GET", "/plain", getPlainPage, kPlain)                                \
    ROUTE("GET", "/assets/{file}", getAsset, kPlain)                            \
    ROUTE("GET", "/openapi.yaml", getOpenApi, kPlain)                           \
    ROUTE("GET", "/livez", getLivez, kPlain)                                    \
    ROUTE("GET", "/readyz", getReadyz, kPlain)                                  \
    ROUTE("GET", "/version", getVersion, kPlain)                                \
    ROUTE("GET", "/metrics", getMetrics, kPlain)                                \
    ROUTE("POST", "/v1/render", postRender, kDrawing)                           \
    ROUTE("POST", "/v1/validate", postValidate, kPlain)                         \
    ROUTE("POST", "/v1/compare", postCompare, kPlain)                           \
    ROUTE("POST", "/v1/grade", postGrade, kPlain)                               \
    ROUTE("GET", "/v1/scenes", listScenes, kPlain)                              \
    ROUTE("POST", "/v1/scenes", postScene, kWriting)                            \
    ROUTE("GET", "/v1/scenes/{id}", getScene, kPlain)                           \
    ROUTE("DELETE", "/v1/scenes/{id}", deleteScene, kWriting)                   \
    ROUTE("GET", "/v1/scenes/{id}/source", getSource, kPlain)                   \
    ROUTE("GET", "/v1/scenes/{id}/models", getModels, kPlain)                   \
    ROUTE("GET", "/v1/scenes/{id}/files", listFiles, kPlain)                    \
    ROUTE("GET", "/v1/scenes/{id}/file", getFile, kPlain)                       \
    ROUTE("GET", "/v1/scenes/{id}/model", getModel, kPlain)                     \
    ROUTE("GET", "/v1/scenes/{id}/turntable", getTurntable, kDrawing)           \
    ROUTE("GET", "/v1/scenes/{id}/image", getImage, kDrawing)                   \
    ROUTE("GET", "/v1/scenes/{id}/thumbnail", getThumbnail, kDrawing)           \
    ROUTE("GET", "/v1/assignments", listAssignments, kTeachers)                 \
    ROUTE("GET", "/v1/assignments/{id}", getAssignment, kPlain)                 \
    ROUTE("PUT", "/v1/assignments/{id}", putAssignment, kTeachers)              \
    ROUTE("DELETE", "/v1/assignments/{id}", deleteAssignment, kTeachers)        \
    ROUTE("GET", "/v1/assignments/{id}/codes", getCodes, kTeachers)             \
    ROUTE("POST", "/v1/assignments/{id}/codes", postCodes, kTeachers)           \
    ROUTE("GET", "/v1/assignments/{id}/submissions", getSubmissions, kTeachers) \
    ROUTE("POST", "/v1/assignments/{id}/check", postAssignmentCheck, kPlain)    \
    ROUTE("GET", "/v1/primitives", listPrimitives, kPlain)                      \
    ROUTE("GET", "/v1/primitives/{shape}", getPrimitive, kPlain)

namespace farol::server {

#define FAROL_DECLARE(method, pattern, handler, traits) \
    http::Response handler(Context& context, const Call& call);
FAROL_ROUTES(FAROL_DECLARE)
#undef FAROL_DECLARE

std::vector<Route> routes() {
    constexpr RouteTraits kPlain{}, kWriting{.isWriting = true}, kDrawing{.drawsProblem = true},
        kTeachers{.isTeachers = true};
#define FAROL_ROW(method, pattern, handler, traits) {method, pattern, handler, traits},
    return {FAROL_ROUTES(FAROL_ROW)};
#undef FAROL_ROW
}

}  // namespace farol::server
