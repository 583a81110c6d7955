#pragma once

#include <GL/glcorearb.h>

/// The GL entry points that the renderer uses. libOSMesa exports those of GL 1 and 2 only, so all
/// are asked for by name. A table belongs to a context: no globals.
namespace farol::render::gl {

// name, type of pointer
#define FAROL_GL_FUNCTIONS(X)                                                        \
    X(ActiveTexture, PFNGLACTIVETEXTUREPROC)                                         \
    X(AttachShader, PFNGLATTACHSHADERPROC)                                           \
    X(BeginQuery, PFNGLBEGINQUERYPROC)                                               \
    X(BindBuffer, PFNGLBINDBUFFERPROC)                                               \
    X(BindBufferBase, PFNGLBINDBUFFERBASEPROC)                                       \
    X(BindFramebuffer, PFNGLBINDFRAMEBUFFERPROC)                                     \
    X(BindTexture, PFNGLBINDTEXTUREPROC)                                             \
    X(BindVertexArray, PFNGLBINDVERTEXARRAYPROC)                                     \
    X(BlendFunc, PFNGLBLENDFUNCPROC)                                                 \
    X(BufferData, PFNGLBUFFERDATAPROC)                                               \
    X(CheckFramebufferStatus, PFNGLCHECKFRAMEBUFFERSTATUSPROC)                       \
    X(ClearBufferfv, PFNGLCLEARBUFFERFVPROC)                                         \
    X(ClipControl, PFNGLCLIPCONTROLPROC)                                             \
    X(ColorMask, PFNGLCOLORMASKPROC)                                                 \
    X(CompileShader, PFNGLCOMPILESHADERPROC)                                         \
    X(CreateProgram, PFNGLCREATEPROGRAMPROC)                                         \
    X(CreateShader, PFNGLCREATESHADERPROC)                                           \
    X(CullFace, PFNGLCULLFACEPROC)                                                   \
    X(DeleteBuffers, PFNGLDELETEBUFFERSPROC)                                         \
    X(DeleteFramebuffers, PFNGLDELETEFRAMEBUFFERSPROC)                               \
    X(DeleteProgram, PFNGLDELETEPROGRAMPROC)                                         \
    X(DeleteQueries, PFNGLDELETEQUERIESPROC)                                         \
    X(DeleteShader, PFNGLDELETESHADERPROC)                                           \
    X(DeleteTextures, PFNGLDELETETEXTURESPROC)                                       \
    X(DeleteVertexArrays, PFNGLDELETEVERTEXARRAYSPROC)                               \
    X(DepthFunc, PFNGLDEPTHFUNCPROC)                                                 \
    X(DepthMask, PFNGLDEPTHMASKPROC)                                                 \
    X(Disable, PFNGLDISABLEPROC)                                                     \
    X(DrawArrays, PFNGLDRAWARRAYSPROC)                                               \
    X(DrawElements, PFNGLDRAWELEMENTSPROC)                                           \
    X(DrawArraysInstancedBaseInstance, PFNGLDRAWARRAYSINSTANCEDBASEINSTANCEPROC)     \
    X(DrawElementsInstancedBaseInstance, PFNGLDRAWELEMENTSINSTANCEDBASEINSTANCEPROC) \
    X(VertexAttribDivisor, PFNGLVERTEXATTRIBDIVISORPROC)                             \
    X(Enable, PFNGLENABLEPROC)                                                       \
    X(EnableVertexAttribArray, PFNGLENABLEVERTEXATTRIBARRAYPROC)                     \
    X(EndQuery, PFNGLENDQUERYPROC)                                                   \
    X(Finish, PFNGLFINISHPROC)                                                       \
    X(FramebufferTexture2D, PFNGLFRAMEBUFFERTEXTURE2DPROC)                           \
    X(FramebufferTextureLayer, PFNGLFRAMEBUFFERTEXTURELAYERPROC)                     \
    X(FrontFace, PFNGLFRONTFACEPROC)                                                 \
    X(GenBuffers, PFNGLGENBUFFERSPROC)                                               \
    X(GenFramebuffers, PFNGLGENFRAMEBUFFERSPROC)                                     \
    X(GenQueries, PFNGLGENQUERIESPROC)                                               \
    X(GenTextures, PFNGLGENTEXTURESPROC)                                             \
    X(GenVertexArrays, PFNGLGENVERTEXARRAYSPROC)                                     \
    X(GetError, PFNGLGETERRORPROC)                                                   \
    X(GetIntegerv, PFNGLGETINTEGERVPROC)                                             \
    X(GetMultisamplefv, PFNGLGETMULTISAMPLEFVPROC)                                   \
    X(GetFloatv, PFNGLGETFLOATVPROC)                                                 \
    X(GetProgramInfoLog, PFNGLGETPROGRAMINFOLOGPROC)                                 \
    X(GetProgramiv, PFNGLGETPROGRAMIVPROC)                                           \
    X(GetQueryObjectuiv, PFNGLGETQUERYOBJECTUIVPROC)                                 \
    X(GetShaderInfoLog, PFNGLGETSHADERINFOLOGPROC)                                   \
    X(GetShaderiv, PFNGLGETSHADERIVPROC)                                             \
    X(GetString, PFNGLGETSTRINGPROC)                                                 \
    X(GetStringi, PFNGLGETSTRINGIPROC)                                               \
    X(GetUniformLocation, PFNGLGETUNIFORMLOCATIONPROC)                               \
    X(LineWidth, PFNGLLINEWIDTHPROC)                                                 \
    X(LinkProgram, PFNGLLINKPROGRAMPROC)                                             \
    X(PixelStorei, PFNGLPIXELSTOREIPROC)                                             \
    X(PointSize, PFNGLPOINTSIZEPROC)                                                 \
    X(PolygonMode, PFNGLPOLYGONMODEPROC)                                             \
    X(PolygonOffset, PFNGLPOLYGONOFFSETPROC)                                         \
    X(ReadPixels, PFNGLREADPIXELSPROC)                                               \
    X(Scissor, PFNGLSCISSORPROC)                                                     \
    X(ShaderSource, PFNGLSHADERSOURCEPROC)                                           \
    X(TexImage2D, PFNGLTEXIMAGE2DPROC)                                               \
    X(TexImage2DMultisample, PFNGLTEXIMAGE2DMULTISAMPLEPROC)                         \
    X(TexStorage2D, PFNGLTEXSTORAGE2DPROC)                                           \
    X(TexStorage3D, PFNGLTEXSTORAGE3DPROC)                                           \
    X(TexSubImage2D, PFNGLTEXSUBIMAGE2DPROC)                                         \
    X(TexParameterf, PFNGLTEXPARAMETERFPROC)                                         \
    X(TexParameteri, PFNGLTEXPARAMETERIPROC)                                         \
    X(Uniform1f, PFNGLUNIFORM1FPROC)                                                 \
    X(Uniform1i, PFNGLUNIFORM1IPROC)                                                 \
    X(Uniform2f, PFNGLUNIFORM2FPROC)                                                 \
    X(Uniform2fv, PFNGLUNIFORM2FVPROC)                                               \
    X(Uniform3fv, PFNGLUNIFORM3FVPROC)                                               \
    X(Uniform4fv, PFNGLUNIFORM4FVPROC)                                               \
    X(UniformMatrix3fv, PFNGLUNIFORMMATRIX3FVPROC)                                   \
    X(UniformMatrix4fv, PFNGLUNIFORMMATRIX4FVPROC)                                   \
    X(UseProgram, PFNGLUSEPROGRAMPROC)                                               \
    X(VertexAttribPointer, PFNGLVERTEXATTRIBPOINTERPROC)                             \
    X(Viewport, PFNGLVIEWPORTPROC)

struct Api {
#define FAROL_GL_MEMBER(name, type) type name = nullptr;
    FAROL_GL_FUNCTIONS(FAROL_GL_MEMBER)
#undef FAROL_GL_MEMBER
};

/// Finds a function of the current context by its name; null where there is none.
using GlFunction = void();
using GetProcAddress = GlFunction*(const char* name);

/// Drops errors that an earlier job left pending.
void clearErrors(const Api& api);

/// Throws std::bad_alloc where the GL has run out of memory, std::runtime_error for other errors
/// that are pending, and drops them. `step` completes "while ...".
void throwOnError(const Api& api, const char* step);

/// Fills the table. Throws std::runtime_error that names the first entry point missing.
Api loadApi(GetProcAddress* loader);

}  // namespace farol::render::gl
