// Read a grid, cover an isosurface with particles, draw it: the two classes in a program that has
// nothing of ParaView.
//
//   isosurface_picture FILE.vtu ARRAY ISOVALUE PICTURE.png

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkHighOrderParticleIsosurface.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSurfaceSplatMapper.h"
#include "vtkWindowToImageFilter.h"
#include "vtkXMLUnstructuredGridReader.h"

#include <cstdlib>
#include <iostream>

namespace
{

void drawTo(vtkActor* actor, const char* picture)
{
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1.0, 1.0, 1.0);
  renderer->AddActor(actor);
  renderer->GetActiveCamera()->SetPosition(-0.8, -1.1, 0.6);
  renderer->GetActiveCamera()->SetViewUp(0.0, 0.0, 1.0);
  renderer->ResetCamera();

  vtkNew<vtkRenderWindow> window;
  window->OffScreenRenderingOn();
  window->SetSize(600, 600);
  window->AddRenderer(renderer);
  window->Render();

  vtkNew<vtkWindowToImageFilter> shot;
  shot->SetInput(window);
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName(picture);
  writer->SetInputConnection(shot->GetOutputPort());
  writer->Write();
}

} // namespace

int main(int argc, char* argv[])
{
  if (argc != 5)
  {
    std::cerr << "usage: isosurface_picture FILE.vtu ARRAY ISOVALUE PICTURE.png\n";
    return EXIT_FAILURE;
  }
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(argv[1]);

  vtkNew<vtkHighOrderParticleIsosurface> surface;
  surface->SetInputConnection(reader->GetOutputPort());
  surface->SetInputArrayToProcess(0, 0, 0, 0, argv[2]);
  surface->SetNumberOfContours(1);
  surface->SetValue(0, std::atof(argv[3]));
  surface->Update();

  vtkNew<vtkSurfaceSplatMapper> mapper;
  mapper->SetInputConnection(surface->GetOutputPort());
  mapper->ScalarVisibilityOff();

  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.85, 0.65, 0.35);
  drawTo(actor, argv[4]);

  const vtkIdType count =
    vtkPolyData::SafeDownCast(surface->GetOutputDataObject(0))->GetNumberOfPoints();
  std::cout << count << " particles, " << argv[4] << "\n";
  return count > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
