/**
 * @struct vtkSurfaceSplatDrawing
 * @brief  what the splat passes draw, and how
 */

#ifndef vtkSurfaceSplatDrawing_h
#define vtkSurfaceSplatDrawing_h

#include <vector>

class vtkOpenGLRenderWindow;
class vtkSurfaceSplatBuffers;
class vtkSurfaceSplatView;

struct vtkSurfaceSplatDrawing
{
  vtkOpenGLRenderWindow* Window = nullptr;
  vtkSurfaceSplatBuffers* Buffers = nullptr;
  const vtkSurfaceSplatView* View = nullptr;
  double RadiusScale = 1.;
  double Sharpness = 2.;
  int Kind = 2;             // 0: opaque particles; 1: translucent ones; 2: all
  int Sheet = -1;           // of these, the ones of this sheet; -1: of all
  int Stride = 1;           // every how-manieth particle is drawn
  bool FacesViewer = false; // there are no normals
  int HiddenSide = 0;       // 1: splats seen from outward are left out; -1: from inward; 0: none
  bool Colors = false;      // colours or lookup coordinates are accumulated
  bool Strongest = false;   // the strongest particle of every pixel is found
  int NumberOfClippingPlanes = 0;
  float ClippingPlanes[6][4] = {}; // shifted model coordinates
  std::vector<double> Key;         // whatever else the picture depends on

  /** All that the picture depends on. */
  std::vector<double> GetWholeKey() const;

  /** Whether splats are so small in the picture that points do. */
  bool DrawsPoints() const;

  /**
   * Whether pixels show one sheet only, however near the others are. (Otherwise there is one, or they are drawn
   * one after the other.)
   */
  bool TellsSheetsApart() const;

  /** Whether splats are bent. */
  bool DrawsCurved() const;
};

#endif
