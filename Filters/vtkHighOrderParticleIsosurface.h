/**
 * @class vtkHighOrderParticleIsosurface
 * @brief isosurfaces of high-order finite elements as evenly spread, oriented particles
 *
 * Input: vtkUnstructuredGrid (or a composite data set of them) with high-order cells and a
 * point array F, or a component or the magnitude of one. Output: vtkPolyData (or a composite of the
 * input's kind) with one point and one vertex cell a particle. Each particle lies on the isosurface
 * F = c of the elements' true polynomials, not of linear pieces, and particles stand at an even spacing
 * in world space, closer where the surface bends, as far as AngularDensity asks for it.
 *
 * The blocks of a composite are one mesh: particles of neighbouring blocks see each other, and go to
 * the block of the cell in which they end. Blocks that have a cell in common, as several results on one
 * grid do, are kept apart. Blocks that lack F, and data sets that are no unstructured grids, take no
 * part and are named in one warning. Where F has fewer tuples than there are points, an error says so and the
 * block takes no part; other arrays that are too short are ignored and named in one warning.
 *
 * After M. Meyer, B. Nelson, R. M. Kirby, R. Whitaker, "Particle Systems for Efficient and Accurate
 * High-Order Finite Element Visualization", IEEE TVCG 13(5), 2007.
 *
 * Cells: linear, quadratic and serendipity hexahedra, tetrahedra, wedges and pyramids; Lagrange and
 * Bezier hexahedra of degree 1 to 15, tetrahedra and wedges of degree 1 to 10, with uniform or
 * anisotropic degrees, rational Bezier cells included. Other cells (polyhedra, pentagonal and hexagonal
 * prisms, 2-D cells), and cells with values that are not finite or without volume, are skipped, counted,
 * and named in one warning, as are partly inverted ones, which are kept. Ghost cells (duplicate, refined or
 * hidden ones by vtkGhostType) carry particles over borders but own none.
 *
 * Point data of the output: `Normals` (unit, towards lower values, as Contour orients them),
 * `Radius` (the particle's own spacing, world units; less where it stands alone on a smaller piece of the
 * surface), `Mean_Curvature` (with respect to Normals;
 * 1/r on a sphere with high values inside), `Gauss_Curvature`, `Shape_Operator` (the derivative of Normals
 * along the surface, a symmetric tensor: xx, yy, zz, xy, yz, xz; 1 / world units), `Residual` (|F - c|/|grad F|,
 * world units), `Clip_Normal`, `Clip_Distance`, `Clip_Angle` and `Clip_Curvature` (from method FAST: unit
 * normals and distances, in world units, of up to two planes near the particle at which the surface ends or
 * turns: boundary curves, or faces between elements; normal zero: none; the largest angle seen there between the
 * normals of both sides, in degrees: 180 at boundary curves, else 1.5 at least, where a step of the surface counts as an
 * angle of step / spacing, below 10; and the curvature of the boundary curve or crease, 1 / world units, positive
 * where it bends towards the normal: the plane touches it where it is nearest; 0 below 10 degrees; splats
 * are to be cut at boundary curves and creases, and to give way to those of the other side where the angle is below 10;
 * where creases meet, a plane is moved outwards if nothing else would cover what it cuts off), `Jump` (on boundary curves
 * where the field jumps from element to element: F - c on the other side; else 0), `Isovalue`,
 * `vtkOriginalCellIds`, `ParametricCoordinates` (of VTK's cell), and every numeric point array of the input
 * evaluated by the element's own polynomials, in double precision (the contoured one holds the isovalue).
 * An input array of one of these names, or of those of the field data below, is not passed on; a warning
 * names it. Cell arrays are copied to the vertex cells.
 * Points are ordered by isovalue, then by cell.
 *
 * Field data of the output: `Evaluations` (of element polynomials), `Iterations` (relaxation
 * sweeps), `ElementsDropped` (cells that provably hold no surface), `CellsSkipped`,
 * `BoxesUnresolved` (parts of cells that were split to 1/4096 of the cell without proof that they hold
 * at most one sheet of the surface), `SingularPoints` (near those, where the gradient vanishes on the
 * surface: cones, isolated points, crossings),
 * `ParticlesRejected` and `ParticlesUndersampled` (curvature times spacing above 2), one value each; and
 * `UnresolvedCellIds`, the cells of those parts. In a composite, cells are those of the block, and all
 * other figures those of the whole mesh.
 *
 * The same input and Seed give the same output, bit for bit, for any number of threads; where a run
 * before is continued (WarmStart), the same runs do.
 *
 * Progress is reported, and AbortExecute looked at, some twenty times a second. An aborted run leaves an
 * empty output, and so do later ones as long as the flag is up. The filter lowers it itself in the first run
 * after a property, here or upstream, or the time step has changed.
 */
#ifndef vtkHighOrderParticleIsosurface_h
#define vtkHighOrderParticleIsosurface_h

#include "vtkHighOrderParticleFiltersModule.h" // for the export macro
#include "vtkNew.h"                            // for the isovalues
#include "vtkPolyDataAlgorithm.h"
#include "vtkTimeStamp.h" // for the last abort

#include <memory> // for the run before
#include <vector> // for the blocks of the input

class InputBlocks;
class PreviousRun;
class vtkContourValues;
struct GatheredBlocks;
struct GridElements;
struct InputBlock;
struct RankShare;
struct RunOrigin;
struct UserMessage;
struct WantedParticles;

namespace hop
{
struct Distribution;
struct Monitor;
}

class VTKHIGHORDERPARTICLEFILTERS_EXPORT vtkHighOrderParticleIsosurface
  : public vtkPolyDataAlgorithm
{
public:
  static vtkHighOrderParticleIsosurface* New();
  vtkTypeMacro(vtkHighOrderParticleIsosurface, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The isovalues, as in vtkContourFilter; one that is given twice counts once. None by default.
   */
  void SetValue(int i, double value);
  double GetValue(int i);
  void SetNumberOfContours(int number);
  vtkIdType GetNumberOfContours();
  ///@}

  ///@{
  /**
   * Distance of neighbouring particles where the surface is flat, world units. Values <= 0 stand
   * for 1/100 of the longest side of the input's bounds. Default 0.
   */
  vtkSetMacro(Spacing, double);
  vtkGetMacro(Spacing, double);
  ///@}

  ///@{
  /**
   * How much denser particles stand where the surface bends (rho of the paper's eq. 6): the spacing
   * becomes s / (1 + rho D s / 2 pi), with the curvature magnitude D, but s / (1 + rho) at least. About
   * the number of particles around a thin tube. 0 spreads them evenly. Range 0 to 100, default 10.
   */
  vtkSetClampMacro(AngularDensity, double, 0.0, 100.0);
  vtkGetMacro(AngularDensity, double);
  ///@}

  ///@{
  /**
   * Largest distance |F - c|/|grad F| of a particle from the isosurface, as a fraction of the
   * diagonal of the input's bounds. Range 1e-14 to 1e-2, default 1e-10;
   * rounding of coordinates and values sets a floor.
   */
  vtkSetClampMacro(Tolerance, double, 1e-14, 1e-2);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * Which component of a vector array to contour by; its number of components or more stands for its
   * magnitude. Scalar arrays have but one. Default 0.
   */
  vtkSetClampMacro(Component, int, 0, VTK_INT_MAX);
  vtkGetMacro(Component, int);
  ///@}

  enum NodeSpacingType
  {
    UNIFORM = 0,
    GAUSS_LOBATTO_LEGENDRE = 1
  };

  ///@{
  /**
   * Where the nodes of Lagrange hexahedra stand: UNIFORM (default), as VTK defines these cells, or at
   * the GAUSS_LOBATTO_LEGENDRE points, as some spectral element codes write them.
   */
  vtkSetClampMacro(NodeSpacing, int, UNIFORM, GAUSS_LOBATTO_LEGENDRE);
  vtkGetMacro(NodeSpacing, int);
  ///@}

  enum MethodType
  {
    CLASSIC = 0,
    FAST = 1
  };

  ///@{
  /**
   * How particles are distributed. FAST (default) seeds them everywhere as dense as wanted and relaxes
   * them on local quadratic approximations of the surface. CLASSIC is the paper's Gauss-Seidel
   * relaxation with split and delete, which needs many times as many evaluations.
   */
  vtkSetClampMacro(Method, int, CLASSIC, FAST);
  vtkGetMacro(Method, int);
  ///@}

  enum QualityType
  {
    DRAFT = 0,
    STANDARD = 1,
    HIGH = 2
  };

  ///@{
  /**
   * How evenly FAST spreads the particles: DRAFT relaxes them in one round, STANDARD (default) in two,
   * HIGH in four. All of them lie on the surface to the Tolerance. CLASSIC relaxes until it is done.
   */
  vtkSetClampMacro(Quality, int, DRAFT, HIGH);
  vtkGetMacro(Quality, int);
  ///@}

  ///@{
  /**
   * Seed of the random choices in the distribution. Default 1.
   */
  vtkSetMacro(Seed, int);
  vtkGetMacro(Seed, int);
  ///@}

  ///@{
  /**
   * If positive, the number of particles for each isovalue, over all blocks and ranks; the spacing then
   * follows, the same on all ranks. Blocks that share cells are isosurfaces of their own. With ghost cells it
   * is about that number. 0 lets Spacing decide. Default 0.
   */
  vtkSetClampMacro(NumberOfParticles, vtkIdType, 0, VTK_ID_MAX);
  vtkGetMacro(NumberOfParticles, vtkIdType);
  ///@}

  ///@{
  /**
   * Whether particles of the last run go on where only an isovalue or the data changed, from one time
   * step to the next or while an isovalue is moved: they stay where they can, and what they miss is
   * added, so that the surface is found and covered as from scratch. Off: the output depends on the
   * input and the properties only, not on runs before. With method FAST. Default on.
   */
  vtkSetMacro(WarmStart, bool);
  vtkGetMacro(WarmStart, bool);
  vtkBooleanMacro(WarmStart, bool);
  ///@}

  /**
   * Whether the output has a point array of that name of its own, whatever the input has.
   */
  static bool IsOwnPointArray(const char* name);

  /**
   * Also counts changes of the isovalues.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkHighOrderParticleIsosurface();
  ~vtkHighOrderParticleIsosurface() override;

  int ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestDataObject(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs);
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;

private:
  vtkHighOrderParticleIsosurface(const vtkHighOrderParticleIsosurface&) = delete;
  void operator=(const vtkHighOrderParticleIsosurface&) = delete;

  /** What follows from the bounds of the whole input, over all blocks and ranks. */
  struct Scale
  {
    double Spacing = 0.0;
    double Tolerance = 0.0;
    double Diagonal = 0.0;
  };
  bool IsAskedForMore(vtkInformationVector* outputs);
  Scale FindScale(const std::vector<InputBlock>& blocks);
  std::vector<double> DistinctIsovalues() const;
  bool Accepts(const GatheredBlocks& gathered, const Scale& scale);
  void Tell(const std::vector<UserMessage>& messages);
  RunOrigin OriginOf(const InputBlocks& blocks, const Scale& scale) const;
  struct Work;
  std::vector<InputBlocks> Group(const InputBlocks& blocks);
  hop::Monitor MonitorOf(double begin, double end);
  void Process(const InputBlocks& blocks, const Scale& scale, std::size_t group, const Work& work);
  template <class Use>
  void UnlessAborted(const InputBlocks& blocks, const Use& use);
  GridElements Convert(const InputBlocks& blocks, const Work& work);
  std::vector<RankShare> ShareOut(
    const InputBlocks& blocks, const GridElements& elements, const Scale& scale, const Work& work);
  WantedParticles CountWanted(const InputBlocks& blocks, const GridElements& elements,
    const Scale& scale, double isovalue, double spacing, const Work& work);
  void Fill(const InputBlocks& blocks, const GridElements& elements, const Scale& scale,
    std::size_t group, const std::vector<RankShare>& shares, const Work& work);
  hop::Distribution Distribute(const GridElements& elements, const Scale& scale,
    const RunOrigin& origin, std::size_t number, const RankShare& share, const Work& work);

  vtkNew<vtkContourValues> ContourValues;
  double Spacing = 0.0;
  double AngularDensity = 10.0;
  double Tolerance = 1e-10;
  int Component = 0;
  int NodeSpacing = UNIFORM;
  int Method = FAST;
  int Quality = STANDARD;
  int Seed = 1;
  vtkIdType NumberOfParticles = 0;
  bool WarmStart = true;
  std::unique_ptr<PreviousRun> Previous;
  /** An abort ends the run it came in, and every repetition of it: ParaView asks for an aborted output again
   * and again. Once something has changed the flag is lowered; ParaView 6.1 never does so. */
  vtkTimeStamp LastAbort;
  double AbortedTime = 0.0;
};

#endif
