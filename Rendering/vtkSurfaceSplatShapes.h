/**
 * @file  vtkSurfaceSplatShapes.h
 * @brief how splats bend, fitted to the particles around
 *
 * A particle knows how the surface bends where it lies, not how that changes over its splat; at the
 * faces of elements, where only the field itself is continuous, it changes at once. The shape operator
 * in the middle then leaves the surface by a tenth of a radius at the rim of the splat. So each splat
 * gets the paraboloid through its particle, and tangent to it there, that suits best where its
 * neighbours lie and how they are turned.
 */

#ifndef vtkSurfaceSplatShapes_h
#define vtkSurfaceSplatShapes_h

struct vtkSurfaceSplatParticles;

/**
 * Replaces the shape operators of particles that have some. Neighbours behind a particle's clip planes,
 * turned away from it or above it do not count; those behind planes at which the surface is almost smooth
 * count less.
 */
void vtkSurfaceSplatFitShapes(vtkSurfaceSplatParticles& particles);

#endif
