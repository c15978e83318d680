/**
 * @file  ParticleData.h
 * @brief whether data on the server are particles of this filter
 */
#pragma once

class vtkPVDataInformation;
class vtkSMProperty;

namespace hop
{

/**
 * Whether data are points with the arrays `Normals`, `Radius` and `Isovalue` and one cell each. Meshes have other numbers
 * of cells.
 */
bool isParticles(vtkPVDataInformation* data);

/**
 * What is known of the data that come through an input property; nullptr where nothing does.
 */
vtkPVDataInformation* dataOf(vtkSMProperty* input);

}
