#ifdef SURFACE
uniform vec3 surfaceLengths;
#if defined(TEXGEN_OBJECT) || defined(TEXGEN_EYE)
uniform vec4 planeS;
uniform vec4 planeT;
#endif
#elif defined(MAPPING_SPHERE)
in vec3 positionMapped;
#endif
#ifdef GOURAUD
COVERED in vec3 modulated;
#ifdef SEPARATE_SPECULAR
COVERED in vec3 added;
#endif
#endif
#ifdef FLAT
flat in vec3 modulated;
#ifdef SEPARATE_SPECULAR
flat in vec3 added;
#endif
#endif
#if (defined(PHONG) || defined(LAYER_NORMAL)) && !defined(SURFACE)
COVERED in vec3 normalView;
#endif
#if defined(PHONG) || defined(LAYER_DEPTH) || (defined(SURFACE) && defined(TEXGEN_EYE))
COVERED in vec3 positionView;
#endif
#ifdef VERTEX_COLOR
COVERED in vec3 vertexColor;
#endif
#ifdef LAYER_NORMAL
uniform mat3 worldFromView;
#endif
#ifdef LAYER_DEPTH
uniform float nearest;
#endif
#if defined(UNLIT) || defined(LAYER_ID)
uniform vec3 plainColor;
#endif

#ifdef EXACT_DEPTH
uniform mat4 clipFromView;
#endif

out vec4 result;

void main() {
#ifdef SURFACE
    float along = toSurface();
    vec3 unit = unitPosition + along * unitRay;
    vec3 normal = normalFromObject * surfaceGradient(unit);
#ifdef EXACT_DEPTH
    // Depth is linear in 1 / distance along the view. Where the mesh is the surface, it is the mesh's to the bit.
    gl_FragDepth = gl_FragCoord.z - clipFromView[3].z * gl_FragCoord.w * along / (1.0 + along);
#endif
#if defined(PHONG) || defined(LAYER_DEPTH) || defined(TEXGEN_EYE)
    vec3 position = positionView * (1.0 + along);
#endif
#else
#if defined(PHONG) || defined(LAYER_NORMAL)
    vec3 normal = normalView;
#endif
#if defined(PHONG) || defined(LAYER_DEPTH)
    vec3 position = positionView;
#endif
#endif
#if defined(TEXTURED) && defined(SURFACE)
    vec3 gradient = surfaceGradient(unit), reach = (1.0 + along) * unitRay;
    vec3 right = tangentChange((1.0 + along) * CHANGE_RIGHT(unitRay), reach, gradient);
    vec3 up = tangentChange((1.0 + along) * CHANGE_UP(unitRay), reach, gradient);
#if defined(MAPPING_SPHERE)
    vec4 texel =
        sampleSphere(unit * surfaceLengths, right * surfaceLengths, up * surfaceLengths);
#elif defined(TEXGEN_OBJECT)
    mat3x2 plane = transpose(mat2x3(planeS.xyz * surfaceLengths, planeT.xyz * surfaceLengths));
    vec4 texel = filtered(plane * unit + vec2(planeS.w, planeT.w), plane * right, plane * up);
#elif defined(TEXGEN_EYE)
    mat3x2 plane = transpose(mat2x3(planeS.xyz, planeT.xyz));
    vec3 eyeRight = tangentChange((1.0 + along) * CHANGE_RIGHT(positionView), position, normal);
    vec3 eyeUp = tangentChange((1.0 + along) * CHANGE_UP(positionView), position, normal);
    vec4 texel =
        filtered(plane * position + vec2(planeS.w, planeT.w), plane * eyeRight, plane * eyeUp);
#else
    vec4 texel = sampleSurface(unit, uv, right, up);
#endif
#elif defined(TEXTURED) && defined(MAPPING_SPHERE)
    vec4 texel =
        sampleSphere(positionMapped, CHANGE_RIGHT(positionMapped), CHANGE_UP(positionMapped));
#elif defined(TEXTURED)
    vec4 texel = sampleMesh();
#endif
#if defined(LAYER_ID)
    result = vec4(plainColor, 1.0);
#elif defined(LAYER_NORMAL)
    result = vec4(worldFromView * unitOr(normal, vec3(0.0, 0.0, 1.0)) * 0.5 + 0.5, 1.0);
#elif defined(LAYER_DEPTH)
    result = vec4(vec3(nearest / max(-position.z, nearest)), 1.0);
#else
#ifdef UNLIT
    vec3 modulated = plainColor;
#endif
#ifdef CHESS
    if ((gl_PrimitiveID & 1) == 1) modulated *= 0.25;
#endif
#ifdef PHONG
    vec3 primary, secondary, modulated, extra;
    shade(position, unitOr(normal, vec3(0.0, 0.0, 1.0)), primary, secondary);
    finish(primary, secondary, modulated, extra);
#endif
    result = vec4(modulated, 1.0);
#ifdef VERTEX_COLOR
    result.rgb *= vertexColor;
#endif
#ifdef TEXTURED
    result.rgb *= texel.rgb;
#endif
#ifdef SEPARATE_SPECULAR
#ifdef PHONG
    result.rgb += extra;
#elif !defined(UNLIT)
    result.rgb += added;
#endif
#endif
#endif
}
