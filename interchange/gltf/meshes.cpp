#include <algorithm>

#include "interchange/gltf/writer.h"
#include "render/plan/texture_ref.h"

namespace farol::interchange {
namespace {

using nlohmann::json;

constexpr int kPoints = 0, kLines = 1;  // modes of primitives
constexpr int kNearest = 9728, kLinear = 9729, kMipmapped = 9987, kClamped = 33071;

/// Identifies a projection of texture coordinates; "" for none.
std::string projectionKey(const scene::Texture* texture, const generator::Mesh& mesh) {
    if (texture == nullptr) return "";
    json key = json::array({static_cast<int>(texture->mapping)});
    if (texture->mapping == scene::Mapping::mesh) {
        const glm::vec4 from = render::uvPlacement(*texture, mesh.uvOrigin());
        for (int k = 0; k < 4; ++k) key.push_back(from[k]);
    }
    if (texture->mapping == scene::Mapping::texgenObject)
        for (int k = 0; k < 4; ++k) key.insert(key.end(), {texture->planeS[k], texture->planeT[k]});
    return key.dump();
}

/// glTF has the origin of texture coordinates at the image's top left.
std::vector<glm::vec2> fromTop(std::vector<glm::vec2> uvs) {
    for (glm::vec2& uv : uvs) uv.y = 1.0F - uv.y;
    return uvs;
}

std::vector<glm::vec3> linearColors(const std::vector<glm::u8vec4>& colors) {
    std::vector<glm::vec3> linear;
    linear.reserve(colors.size());
    for (const glm::u8vec4& color : colors) linear.push_back(linearOf(glm::vec3(color) / 255.0F));
    return linear;
}

bool isBlack(const glm::vec3& color) { return color == glm::vec3(0.0F); }

/// Returns the name of a texture's file without folders and extension; "" for none.
std::string stemOf(const scene::Texture* texture) {
    if (texture == nullptr) return "";
    const std::size_t from = texture->file.find_last_of("/\\") + 1;
    return texture->file.substr(from, texture->file.rfind('.') - from);
}

}  // namespace

const GltfWriter::Geometry& GltfWriter::geometryOf(const render::MeshData& data,
                                                   const scene::Texture* texture, bool hasLines) {
    const generator::Mesh& mesh = data.mesh;
    const auto key =
        std::make_pair(data.id, (hasLines ? "lines" : "") + projectionKey(texture, mesh));
    const auto [at, isNew] = geometries_.emplace(key, Geometry{});
    Geometry& geometry = at->second;
    if (!isNew) return geometry;
    const MappedMesh parts = mapped(mesh, texture);
    geometry.positions = document_.addPositions(parts.positions);
    if (!parts.normals.empty() && !hasLines) geometry.normals = document_.addNormals(parts.normals);
    if (!parts.uvs.empty()) geometry.uvs = document_.addUvs(fromTop(parts.uvs));
    if (!parts.colors.empty()) geometry.colors = document_.addColors(linearColors(parts.colors));
    const bool isOutlined = hasLines && subject_.shading() == scene::Shading::wireframe;
    // Meshes without other texture coordinates than a shared one share the indices, too.
    const auto plain = geometries_.find({data.id, ""});
    if (!hasLines && !parts.isSplit && plain != geometries_.end() && plain->second.indexCount > 0) {
        geometry.indices = plain->second.indices;
        geometry.indexCount = plain->second.indexCount;
        return geometry;
    }
    const std::vector<std::uint32_t> indices = isOutlined ? edgesOf(parts.indices) : parts.indices;
    geometry.indices = document_.addIndices(indices);
    geometry.indexCount = indices.size();
    return geometry;
}

std::optional<GltfWriter::Embedded> GltfWriter::addTexture(const scene::Texture& texture) {
    const render::TextureRef ref = render::refOf(texture, subject_.assets());
    const auto [at, isNew] = images_.emplace(ref.key, Embedded{});
    if (isNew) {
        const PortableImage image = imageOf(texture, subject_.assets());
        const int view = document_.addView(image.bytes, Target::none);
        json entry{{"bufferView", view}, {"mimeType", image.mime}};
        if (const std::string name = stemOf(&texture); !name.empty()) entry["name"] = name;
        at->second = {document_.addOnce("images", std::move(entry)), image.alpha};
    }
    const scene::Filter filter = subject_.options().filter.value_or(ref.filter);
    json sampler{{"magFilter", filter == scene::Filter::nearest ? kNearest : kLinear},
                 {"minFilter", filter == scene::Filter::nearest  ? kNearest
                               : filter == scene::Filter::linear ? kLinear
                                                                 : kMipmapped}};
    if (ref.clamp) sampler["wrapS"] = sampler["wrapT"] = kClamped;
    const int index = document_.addOnce(
        "textures",
        {{"sampler", document_.addOnce("samplers", sampler)}, {"source", at->second.index}});
    return Embedded{index, at->second.alpha};
}

int GltfWriter::addMaterial(const Look& look, bool hasLines) {
    json material = json::object();
    const std::string name = look.name.empty() ? stemOf(look.texture) : look.name;
    if (!name.empty()) material["name"] = name;
    if (look.isTwoSided) material["doubleSided"] = true;
    json pbr{{"metallicFactor", 0}};
    std::optional<int> texture;
    image::Alpha alpha = look.opacity < 1.0F ? image::Alpha::blended : image::Alpha::opaque;
    if (look.texture != nullptr) {
        const std::optional<Embedded> image = addTexture(*look.texture);
        if (image) texture = image->index;
        if (image && subject_.isTransparent()) alpha = std::max(alpha, image->alpha);
    }
    if (alpha != image::Alpha::opaque)
        material["alphaMode"] = alpha == image::Alpha::cutOut ? "MASK" : "BLEND";
    if (texture) pbr["baseColorTexture"] = {{"index", *texture}};
    const PhongColors& colors = look.colors;
    const auto setBase = [&](const glm::vec3& linear) {
        pbr["baseColorFactor"] = {linear.r, linear.g, linear.b, look.opacity};
    };
    const bool isEmissive =
        isBlack(colors.diffuse) && isBlack(colors.specular) && !isBlack(colors.base);
    if (!subject_.isLit() || hasLines || isEmissive) {
        document_.use("KHR_materials_unlit");
        material["extensions"]["KHR_materials_unlit"] = json::object();
        pbr["roughnessFactor"] = 1;
        setBase(linearOf(subject_.isLit() && !hasLines ? colors.base : colors.diffuse));
    } else {
        const PbrMaterial nearest = pbrOf(colors);
        setBase(nearest.baseColor);
        pbr["roughnessFactor"] = nearest.roughness;
        if (!isBlack(nearest.emissive)) {
            material["emissiveFactor"] = toJson(nearest.emissive);
            if (texture) material["emissiveTexture"] = {{"index", *texture}};
        }
        document_.use("KHR_materials_specular");
        json& specular = material["extensions"]["KHR_materials_specular"];
        // The colour alone says how much is reflected: Blender 3 does not read the factor.
        specular = {{"specularColorFactor", toJson(nearest.reflectance / kUnitReflectance)}};
        if (isBlack(nearest.reflectance)) specular["specularFactor"] = 0;
    }
    material["pbrMetallicRoughness"] = std::move(pbr);
    return document_.addOnce("materials", material);
}

int GltfWriter::addMesh(const scene::Model& model, const render::MeshData& data,
                        const std::vector<Look>& looks) {
    const scene::Shading shading = subject_.shading();
    const bool isPoints = shading == scene::Shading::points;
    const bool hasLines = isPoints || shading == scene::Shading::wireframe;
    json primitives = json::array();
    for (const Look& look : looks) {
        if (look.count == 0) continue;
        const Geometry& geometry = geometryOf(data, look.texture, hasLines);
        json attributes{{"POSITION", geometry.positions}};
        const bool isFlat = shading == scene::Shading::flat;
        if (geometry.normals >= 0 && subject_.isLit() && !isFlat)
            attributes["NORMAL"] = geometry.normals;
        if (geometry.uvs >= 0) attributes["TEXCOORD_0"] = geometry.uvs;
        if (geometry.colors >= 0 && look.isColored) attributes["COLOR_0"] = geometry.colors;
        json primitive{{"attributes", attributes}, {"material", addMaterial(look, hasLines)}};
        if (!isPoints)
            primitive["indices"] =
                hasLines ? document_.addIndexAccessor(geometry.indices, 0, geometry.indexCount)
                         : document_.addIndexAccessor(geometry.indices, look.first, look.count);
        if (hasLines) primitive["mode"] = isPoints ? kPoints : kLines;
        primitives.push_back(std::move(primitive));
        if (hasLines) break;  // one colour draws all edges
    }
    const auto [at, isNew] = meshes_.emplace(primitives.dump(), 0);
    if (!isNew) return at->second;
    written_.triangles += static_cast<std::int64_t>(data.mesh.triangles());
    json mesh{{"primitives", std::move(primitives)}};
    const std::string& source = model.file.empty() ? model.command : model.file;
    if (!source.empty()) mesh["name"] = source;
    return at->second = document_.add("meshes", std::move(mesh));
}

std::optional<int> GltfWriter::addModel(const scene::Model& model, const scene::Scene& in) {
    const std::shared_ptr<const render::MeshData> data = subject_.meshOf(model);
    if (data->mesh.indices().empty()) return std::nullopt;
    json node{{"mesh", addMesh(model, *data, subject_.looksOf(model, *data, in))}};
    const std::string& name = !model.name.empty()  ? model.name
                              : !model.id.empty()  ? model.id
                              : model.file.empty() ? model.command
                                                   : model.file;
    if (!name.empty()) node["name"] = name;
    if (data->mesh.origin() != glm::dvec3(0.0)) node["translation"] = toJson(data->mesh.origin());
    return document_.add("nodes", std::move(node));
}

}  // namespace farol::interchange
