//VTK::System::Dec

// Vertex stage of the resolve pass, inside VTK's template for polygonal data: a rectangle around the
// splats in the picture.

uniform vec4 splatRectangleDC; // left, bottom, right, top

//VTK::CustomUniforms::Dec

void main()
{
  vec2 corner = vec2(gl_VertexID % 2, gl_VertexID / 2);
  gl_Position = vec4(mix(splatRectangleDC.xy, splatRectangleDC.zw, corner), 0.0, 1.0);
}
