// How far a place with these disk coordinates lies behind a clip line, in MC; negative before it. See splatClipLine().
float splatBehindLine(vec4 line, vec2 place)
{
  float along = line.x * place.y - line.y * place.x;
  return dot(line.xy, place) - line.z - line.w * along * along;
}
