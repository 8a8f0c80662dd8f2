#include "viewer/platform/gl.h"

#include <string>

namespace etendue::viewer {

bool Gl::load(const Loader& loader) {
  bool complete = true;
  const auto get = [&](auto& function, const char* name) {
    function =
        reinterpret_cast<std::remove_reference_t<decltype(function)>>(loader((std::string("gl") + name).c_str()));
    complete = complete && function != nullptr;
  };
  get(GetString, "GetString"), get(Viewport, "Viewport"), get(Clear, "Clear"), get(ClearColor, "ClearColor");
  get(Disable, "Disable"), get(Enable, "Enable"), get(Scissor, "Scissor"), get(Finish, "Finish"),
      get(ReadPixels, "ReadPixels"), get(PixelStorei, "PixelStorei");
  get(GenTextures, "GenTextures"), get(DeleteTextures, "DeleteTextures"), get(BindTexture, "BindTexture");
  get(ActiveTexture, "ActiveTexture"), get(TexImage2D, "TexImage2D"), get(TexSubImage2D, "TexSubImage2D");
  get(TexParameteri, "TexParameteri"), get(GenFramebuffers, "GenFramebuffers");
  get(DeleteFramebuffers, "DeleteFramebuffers"), get(BindFramebuffer, "BindFramebuffer");
  get(FramebufferTexture2D, "FramebufferTexture2D"), get(CheckFramebufferStatus, "CheckFramebufferStatus");
  get(BlitFramebuffer, "BlitFramebuffer"), get(GenVertexArrays, "GenVertexArrays");
  get(DeleteVertexArrays, "DeleteVertexArrays"), get(BindVertexArray, "BindVertexArray"), get(DrawArrays, "DrawArrays");
  get(CreateShader, "CreateShader"), get(ShaderSource, "ShaderSource"), get(CompileShader, "CompileShader");
  get(GetShaderiv, "GetShaderiv"), get(GetShaderInfoLog, "GetShaderInfoLog"), get(DeleteShader, "DeleteShader");
  get(CreateProgram, "CreateProgram"), get(AttachShader, "AttachShader"), get(LinkProgram, "LinkProgram");
  get(GetProgramiv, "GetProgramiv"), get(DeleteProgram, "DeleteProgram"), get(UseProgram, "UseProgram");
  get(GetUniformLocation, "GetUniformLocation"), get(Uniform1i, "Uniform1i"), get(Uniform1f, "Uniform1f");
  get(Uniform2f, "Uniform2f"), get(Uniform3fv, "Uniform3fv");
  return complete;
}

}  // namespace etendue::viewer
