layout(location = 0) in vec3 positionObject;
layout(location = 1) in vec3 normalObject;
layout(location = 2) in vec2 uvIn;
#ifdef FLAT
layout(location = 3) in vec3 centerObject;  // the middle of the face
#endif
#ifdef EYE_POSITIONS
layout(location = 13) in vec3 positionEye;  // placed in double; positionObject: from the viewer
#endif
#if defined(EYE_POSITIONS) && defined(GOURAUD)
// Of the whole triangle that this piece was cut from: it is lit at its own corners.
layout(location = 3) in vec3 cornerPositions[3];
layout(location = 6) in vec3 cornerNormals[3];
layout(location = 9) in vec3 cornerShares;
#endif
#ifdef VERTEX_COLOR
layout(location = 12) in vec4 colorIn;
COVERED out vec3 vertexColor;
#endif

#ifdef INSTANCED
layout(location = 4) in mat4 viewFromObject;
#ifdef SURFACE
layout(location = 8) in mat3 normalIn;
layout(location = 11) in vec3 unitEye;
flat out mat3 normalFromObject;
#else
layout(location = 8) in mat3 normalFromObject;
#endif
#else
uniform mat4 viewFromObject;
#ifdef SURFACE
uniform vec3 unitEye;
#else
uniform mat3 normalFromObject;
#endif
#endif
#ifdef SURFACE
uniform vec3 unitFromObject;  // scale
RAY out vec3 unitPosition;
RAY out vec3 unitRay;
#if defined(SURFACE_CAPS)
flat out float cap;
#elif defined(SURFACE_PROFILE)
COVERED out vec2 profileNormal;
COVERED out vec3 unitCovered;
#endif
#endif
uniform mat4 clipFromView;
// The depths of a pass of depths alone are those of the shaded one.
invariant gl_Position;

#if (defined(TEXGEN_OBJECT) || defined(TEXGEN_EYE)) && !defined(SURFACE)
uniform vec4 planeS;
uniform vec4 planeT;
#endif

#ifdef TEXTURED
RAY out vec2 uv;
#if !defined(SURFACE) && !defined(TEXGEN_OBJECT) && !defined(TEXGEN_EYE)
uniform vec4 uvFrom;  // scale, offset
#endif
#endif
#if defined(MAPPING_SPHERE) && !defined(SURFACE)
out vec3 positionMapped;
uniform vec3 mappedFrom;  // the mesh's origin
#endif
#ifdef GOURAUD
COVERED out vec3 modulated;
#ifdef SEPARATE_SPECULAR
COVERED out vec3 added;
#endif
#endif
#ifdef FLAT
flat out vec3 modulated;
#ifdef SEPARATE_SPECULAR
flat out vec3 added;
#endif
#endif
#if (defined(PHONG) || defined(LAYER_NORMAL)) && !defined(SURFACE)
COVERED out vec3 normalView;
#endif
#if defined(PHONG) || defined(LAYER_DEPTH) || (defined(SURFACE) && defined(TEXGEN_EYE))
COVERED out vec3 positionView;
#endif
#if defined(SHADOWED) && (!defined(SURFACE) || defined(SURFACE_PROFILE))
out vec3 facePosition;
#endif

#ifdef CARRIED
void carry() {
    for (int i = 0; i < LIGHT_COUNT; ++i) {
        carried.lightTo[i] = LIGHT_TO(i);
#ifdef SHADOWED
        carried.lightAmbient[i] = LIGHT_AMBIENT(i);
#else
        carried.lightAmbient[i] = AMBIENT(i);
#endif
        carried.lightDiffuse[i] = LIGHT_DIFFUSE(i);
#ifdef POSITIONAL
        carried.lightPlaced[i] = LIGHT_PLACED(i);
        carried.lightAttenuation[i] = LIGHT_ATTENUATION(i);
#endif
#ifdef SPOT
        carried.lightSpot[i] = LIGHT_SPOT(i);
        carried.lightExponent[i] = LIGHT_EXPONENT(i);
#endif
#ifdef SPECULAR
        carried.lightSpecular[i] = LIGHT_SPECULAR(i);
#endif
    }
#ifdef SPECULAR
    carried.materialSpecular = materialSpecular;
    carried.materialShininess = materialShininess;
#endif
    carried.materialDiffuse = materialDiffuse;
    carried.materialBase = materialBase;
#ifdef SHADOWED
    carried.materialAmbient = materialAmbient;
#endif
#ifdef SURFACE
#ifndef INSTANCED
    carried.normalFromObject = normalFromObject;
#endif
    carried.seenFrom = seenFrom;
    carried.surfaceForm = surfaceForm;
#ifdef TEXTURED
    carried.surfaceLengths = surfaceLengths;
    carried.surfaceUv = surfaceUv;
    carried.surfaceDiscs = surfaceDiscs;
    carried.balance = balance;
#endif
#endif
}
#endif

void main() {
#ifdef EYE_POSITIONS
    vec4 position = vec4(positionEye, 1.0);
#else
    vec4 position = viewFromObject * vec4(positionObject, 1.0);
#endif
    gl_Position = clipFromView * position;
#ifdef CARRIED
    carry();
#endif
#ifdef TEXTURED
    uv = uvIn;
#ifndef SURFACE
#if !defined(TEXGEN_OBJECT) && !defined(TEXGEN_EYE)
    uv = uvIn * uvFrom.xy + uvFrom.zw;
#endif
#ifdef TEXGEN_OBJECT
    uv = vec2(dot(planeS, vec4(positionObject, 1.0)), dot(planeT, vec4(positionObject, 1.0)));
#endif
#ifdef TEXGEN_EYE
    uv = vec2(dot(planeS, position), dot(planeT, position));
#endif
#endif
#endif
#if defined(MAPPING_SPHERE) && !defined(SURFACE)
    positionMapped = positionObject + mappedFrom;
#endif
#ifdef VERTEX_COLOR
    vertexColor = colorIn.rgb;
#endif
#if defined(EYE_POSITIONS) && defined(GOURAUD)
    modulated = vec3(0.0);
#ifdef SEPARATE_SPECULAR
    added = vec3(0.0);
#endif
    for (int k = 0; k < 3; ++k) {
        vec3 normal = unitOr(normalFromObject * cornerNormals[k], vec3(0.0, 0.0, 1.0));
        vec3 primary, secondary, first, second;
        shade(clamp(cornerPositions[k], -1e18, 1e18), normal, primary, secondary);
        finish(primary, secondary, first, second);
        modulated += cornerShares[k] * first;
#ifdef SEPARATE_SPECULAR
        added += cornerShares[k] * second;
#endif
    }
#elif defined(GOURAUD) || defined(FLAT)
#ifdef FLAT
    position = viewFromObject * vec4(centerObject, 1.0);
#endif
    vec3 normal = unitOr(normalFromObject * normalObject, vec3(0.0, 0.0, 1.0));
    vec3 primary, secondary, spare;
    // Squares of what is farther are no floats; it is out of view, but its light is interpolated.
    shade(clamp(position.xyz, -1e18, 1e18), normal, primary, secondary);
#ifdef SEPARATE_SPECULAR
    finish(primary, secondary, modulated, added);
#else
    finish(primary, secondary, modulated, spare);
#endif
#endif
#ifdef SURFACE
#ifdef EYE_POSITIONS
    unitRay = positionObject * unitFromObject;
    unitPosition = unitEye + unitRay;
#else
    unitPosition = positionObject * unitFromObject;
    unitRay = unitPosition - unitEye;
#endif
#ifdef INSTANCED
    normalFromObject = normalIn;
#endif
#if defined(SURFACE_CAPS)
    cap = normalObject.x == 0.0 && normalObject.z == 0.0 ? normalObject.y : 0.0;
#elif defined(SURFACE_PROFILE)
    // On the axis the coordinates alone say where the vertex's slice is.
    float turn = 6.28318530717959 * uvIn.x;
    profileNormal = vec2(dot(normalObject.xz, vec2(cos(turn), -sin(turn))), normalObject.y);
    unitCovered = unitPosition;
#endif
#elif defined(PHONG) || defined(LAYER_NORMAL)
    normalView = normalFromObject * normalObject;
#endif
#if defined(PHONG) || defined(LAYER_DEPTH) || (defined(SURFACE) && defined(TEXGEN_EYE))
    positionView = position.xyz;
#endif
#if defined(SHADOWED) && (!defined(SURFACE) || defined(SURFACE_PROFILE))
    facePosition = position.xyz;
#endif
}
