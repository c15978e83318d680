/**
 * @class vtkHighOrderParticleIsosurface
 * @brief isosurfaces of high-order finite elements as evenly spread, oriented particles
 *
 * Input: vtkUnstructuredGrid (or a composite data set of such grids) with high-order cells and a point array F, or
 * a component or the magnitude of one. Output: vtkPolyData (or a composite of the input's kind) with one point and one
 * vertex cell a particle. Each particle lies on the isosurface F = c of the elements' true polynomials, not of linear
 * pieces. Particles stand at an even spacing in world space, closer where the surface bends, as far as AngularDensity
 * asks for it. Points are ordered by isovalue, then by cell.
 *
 * With OutputType TRIANGLES the output is vtkPolyData as well, a mesh of the surface whose points are the particles, and
 * with CURVED_TRIANGLES it is vtkUnstructuredGrid of VTK_LAGRANGE_TRIANGLE cells with further points on the surface.
 * Particles in one place on the two sides of a crease are one point there, with the mean normal. A triangle belongs to
 * the block of its first corner; corners in other blocks are copied. Cell arrays are those of the cell in which the first
 * corner lies, and `Cell_Id`. What a mesh lacks stands in its field data, under names that begin with Mesh.
 *
 * The blocks of a composite are one mesh: particles of neighbouring blocks see each other, and each goes to the block
 * of the cell in which it ends. Blocks that have a cell in common, as several results on one grid do, are kept apart.
 * Blocks that lack F, and data sets that are no unstructured grids, take no part and are named in one warning. Where F
 * has fewer tuples than there are points, an error says so and the block takes no part; other arrays that are too short
 * are ignored and named in one warning.
 *
 * After M. Meyer, B. Nelson, R. M. Kirby, R. Whitaker, "Particle Systems for Efficient and Accurate High-Order Finite
 * Element Visualization", IEEE TVCG 13(5), 2007.
 *
 * Cells: linear, quadratic and serendipity hexahedra, tetrahedra, wedges and pyramids; Lagrange and Bezier hexahedra of
 * degree 1 to 15, tetrahedra and wedges of degree 1 to 10, with uniform or anisotropic degrees, rational Bezier cells
 * included. Other cells (polyhedra, pentagonal and hexagonal prisms, 2-D cells), and cells with values that are not
 * finite or without volume, are skipped, counted, and named in one warning. Partly inverted cells are kept, and named
 * there as well. Ghost cells (duplicate, refined or hidden ones by vtkGhostType) are left out.
 *
 * On several MPI ranks the surface is one: all ranks together have the particles that one rank has, bit for bit, however
 * cells lie on ranks. Each isosurface is distributed by one rank, and particles are given to the rank of their cell.
 *
 * Point data of the output: every numeric point array of the input, evaluated by the element's own polynomials in
 * double precision (the contoured one holds the isovalue), and arrays of the filter's own:
 * - geometry: `Normals`, `Radius`, `Area`, `Mean_Curvature`, `Gauss_Curvature`, `Residual`;
 * - where the particle is: `Isovalue`, `Cell_Id` and, with the same ids in the same memory, `vtkOriginalCellIds`;
 * - for the renderer alone, in the hidden array `__vtkValidMask__Splats`: `Shape_Operator`; where the surface ends or
 *   turns near the particle: `Clip_Normal`, `Clip_Distance`, `Clip_Angle`, `Clip_Curvature` (with method FAST);
 *   where the particle was computed, for filters that move it: `Original_Placement`; where its cell ends on the
 *   surface: `Cell_Borders` (with method FAST). In meshes with creases another hidden array has
 *   the normals of both sides, and what this one has of one of them, of the other one (Common/SplatColumns.h).
 *
 * With PassDiagnostics these are arrays under their own names, and `Jump` and `ParametricCoordinates` come with them.
 *
 * Cell arrays are copied to the vertex cells. Field data of the output: those of the input, and with PassDiagnostics a
 * report of what the run cost and could not do: `Evaluations`, `Iterations`, `ElementsDropped`, `CellsSkipped`, `BoxesUnresolved`,
 * `SingularPoints`, `ParticlesRejected`, `ParticlesUndersampled`, `FacesReached`, `FacesEnded` and `UnresolvedCellIds`. In a composite, cells are
 * those of the block, and all other figures those of the whole mesh.
 *
 * GetOutputArrayDescription() says what each array of the filter's own means, with its unit. A point or field array of
 * the input with one of these names is not passed on; a warning names it.
 *
 * The same input and Seed give the same output, bit for bit, for any number of threads; where a previous run is
 * continued (WarmStart), the same sequence of runs does. Where the pipeline asks again and neither a property nor any
 * value of the input has changed, the output of the last run is given again: nothing is computed or told twice.
 *
 * Some twenty times a second the filter reports its progress and looks at AbortExecute. An aborted run leaves an empty
 * output, and so do later runs as long as the flag is up. The filter lowers it itself in the first run after a property,
 * here or upstream, or the time step has changed.
 */
#ifndef vtkHighOrderParticleIsosurface_h
#define vtkHighOrderParticleIsosurface_h

#include "vtkHighOrderParticleFiltersModule.h" // for the export macro
#include "vtkNew.h"                            // for the isovalues
#include "vtkPolyDataAlgorithm.h"
#include "vtkTimeStamp.h" // for the last abort

#include <cstdint> // for a request's hash
#include <memory>  // for the previous run
#include <string>  // for the expression
#include <vector>  // for the messages

class vtkContourValues;

namespace hop
{
class ByteHash;
class InputBlocks;
class KeptOutput;
class PreviousRun;
struct CheckedBlocks;
struct GatheredBlocks;
struct RunCaller;
struct RunProperties;
struct RunScale;
struct UserMessage;
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
   * The isovalues, as in vtkContourFilter; a value that is given twice counts once. None by default.
   */
  void SetValue(int i, double value);
  double GetValue(int i);
  void SetNumberOfContours(int number);
  vtkIdType GetNumberOfContours();
  ///@}

  ///@{
  /**
   * Distance of neighbouring particles where the surface is flat, world units. Half of it means up to four times the
   * particles. Values <= 0 stand for 1/100 of the longest side of the input's bounds. Default 0.
   */
  vtkSetMacro(Spacing, double);
  vtkGetMacro(Spacing, double);
  ///@}

  ///@{
  /**
   * How much denser particles stand where the surface bends (rho of the paper's eq. 6): the spacing s becomes
   * s / (1 + rho D s / 2 pi), with the curvature magnitude D, but at least SmallestSpacing. The value is about the
   * number of particles around a thin tube, without unit. 0 spreads them evenly. Range 0 to 100, default 10.
   */
  vtkSetClampMacro(AngularDensity, double, 0.0, 100.0);
  vtkGetMacro(AngularDensity, double);
  ///@}

  ///@{
  /**
   * Distance of neighbouring particles below which AngularDensity brings them nowhere, world units. Values <= 0 stand
   * for s / (1 + 8 rho), which follows tubes down to a radius of s / 50. Default 0.
   */
  vtkSetMacro(SmallestSpacing, double);
  vtkGetMacro(SmallestSpacing, double);
  ///@}

  ///@{
  /**
   * Largest distance |F - c|/|grad F| of a particle from the isosurface, as a fraction of the
   * diagonal of the input's bounds. Rounding of coordinates and values sets a lower limit. Range 1e-14 to 1e-2,
   * default 1e-10.
   */
  vtkSetClampMacro(Tolerance, double, 1e-14, 1e-2);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * Which component of a vector array to contour by; its number of components, or more, stands for its magnitude.
   * Ignored for scalar arrays. Default VTK_INT_MAX, the magnitude of any vector.
   */
  vtkSetClampMacro(Component, int, 0, VTK_INT_MAX);
  vtkGetMacro(Component, int);
  ///@}

  enum QuantityType
  {
    VALUE = 0,
    GRADIENT_MAGNITUDE = 1,
    DIVERGENCE = 2,
    VORTICITY_MAGNITUDE = 3,
    Q_CRITERION = 4,
    LAMBDA_2 = 5,
    EXPRESSION = 6
  };

  ///@{
  /**
   * What is contoured: the VALUE (default) of the chosen component, or the magnitude of the vector; or a field made of
   * the derivatives of the array in world space, taken in each cell: GRADIENT_MAGNITUDE of the component or, of all
   * components, the square root of the sum of their squares; of vectors of three components DIVERGENCE,
   * VORTICITY_MAGNITUDE (of the curl), Q_CRITERION, -tr(grad u grad u)/2, and LAMBDA_2, the middle eigenvalue of S^2 + W^2,
   * whatever the Component. Derived fields are those of the cells' polynomials, exact or to 1e-9 of their largest value in a
   * cell, and jump from cell to cell, so that their isosurfaces have boundary curves between cells.
   */
  vtkSetClampMacro(Quantity, int, VALUE, EXPRESSION);
  vtkGetMacro(Quantity, int);
  ///@}

  ///@{
  /**
   * The formula that EXPRESSION contours, in the grammar of ParaView's calculator: of point arrays (whatever the chosen one),
   * their components (u_X, u_Y, u_Z), coordsX to coordsZ, and of arrays gradient(), curl(), divergence(), q_criterion() and lambda2().
   * Empty by default.
   */
  vtkSetStdStringFromCharMacro(Expression);
  vtkGetCharFromStdStringMacro(Expression);
  ///@}

  enum DerivativesType
  {
    IN_EACH_CELL = 0,
    AVERAGED_AT_NODES = 1
  };

  ///@{
  /**
   * Of which derivatives Quantity is made but for EXPRESSION: those IN_EACH_CELL (default), of the cell's own polynomial, which jump from
   * cell to cell; or those AVERAGED_AT_NODES, as vtkGradientFilter has them: the quantity is computed at the nodes from the means of
   * the gradients in all cells around, also where each cell has points of its own, and interpolated between them. Averages
   * make closed surfaces and are no more accurate; they end at blocks and MPI ranks.
   */
  vtkSetClampMacro(Derivatives, int, IN_EACH_CELL, AVERAGED_AT_NODES);
  vtkGetMacro(Derivatives, int);
  ///@}

  enum NodeSpacingType
  {
    UNIFORM = 0,
    GAUSS_LOBATTO_LEGENDRE = 1
  };

  ///@{
  /**
   * Where the nodes of Lagrange hexahedra stand: UNIFORM (default), as VTK defines these cells, or at the
   * GAUSS_LOBATTO_LEGENDRE points, as some spectral element codes write them.
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
   * HIGH in four. All particles lie on the surface to the Tolerance. CLASSIC relaxes until it has converged.
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
   * Number of particles that a worker is worth: an isosurface that takes several times as many is distributed by several
   * workers, each in a slab across one direction, on different MPI ranks where there are some. How many workers there
   * are, and so where particles stand, depends on the surface alone and not on the number of ranks. One worker makes
   * meshes, given numbers and Classic, and goes on from a previous run. 0: one worker always. Default 0.
   */
  vtkSetClampMacro(ParticlesPerWorker, vtkIdType, 0, VTK_ID_MAX);
  vtkGetMacro(ParticlesPerWorker, vtkIdType);
  ///@}

  ///@{
  /**
   * If positive, the number of particles for each isovalue, over all blocks and ranks; the spacing then
   * follows. Blocks that share cells are isosurfaces of their own. 0 lets Spacing decide. Default 0.
   */
  vtkSetClampMacro(NumberOfParticles, vtkIdType, 0, VTK_ID_MAX);
  vtkGetMacro(NumberOfParticles, vtkIdType);
  ///@}

  ///@{
  /**
   * Whether particles of the previous run go on where only an isovalue or the data changed, from one time step to the
   * next or while an isovalue is moved: they stay where they can, and particles are added where they leave the surface
   * uncovered. The surface is found and covered as in a run from scratch, and a run takes a little longer than that: what
   * is won is that particles of films do not flicker. Off: the output depends on the input and the properties only, not on
   * previous runs. With method FAST. Default off.
   */
  vtkSetMacro(WarmStart, bool);
  vtkGetMacro(WarmStart, bool);
  vtkBooleanMacro(WarmStart, bool);
  ///@}

  enum OutputTypes
  {
    PARTICLES = 0,
    TRIANGLES = 1,
    CURVED_TRIANGLES = 2
  };

  ///@{
  /**
   * What the output is made of: PARTICLES (default); a mesh of TRIANGLES whose corners are the particles; or
   * CURVED_TRIANGLES, Lagrange triangles of the given Order whose nodes all lie on the isosurface.
   */
  vtkSetClampMacro(OutputType, int, PARTICLES, CURVED_TRIANGLES);
  vtkGetMacro(OutputType, int);
  ///@}

  ///@{
  /**
   * Polynomial order of curved triangles. Range 2 to 4, default 2.
   */
  vtkSetClampMacro(Order, int, 2, 4);
  vtkGetMacro(Order, int);
  ///@}

  ///@{
  /**
   * Whether the output tells how it was made: the arrays of the renderer under their names, more about the place of
   * particles, and the report of the run. Default off: what only the renderer reads is one array, marked by
   * vtkAbstractArray::GUI_HIDE.
   */
  vtkSetMacro(PassDiagnostics, bool);
  vtkGetMacro(PassDiagnostics, bool);
  vtkBooleanMacro(PassDiagnostics, bool);
  ///@}

  ///@{
  /**
   * Whether the output has derivatives of the contoured array at the particles, in world space, by the polynomials of
   * their own cells: Gradient, three numbers a component (du_i/dx_j, j running fastest), and of vectors of three
   * components Vorticity and Q_Criterion. Default off.
   */
  vtkSetMacro(PassDerivatives, bool);
  vtkGetMacro(PassDerivatives, bool);
  vtkBooleanMacro(PassDerivatives, bool);
  ///@}

  /**
   * Whether the filter keeps a name for a point array of its own, whatever arrays the input has.
   */
  static bool IsOwnPointArray(const char* name);

  ///@{
  /**
   * The arrays that outputs with PassDiagnostics have, whatever arrays the input has: name, vtkDataObject::POINT or FIELD, number of
   * components, and a text that says what the numbers mean and what their unit is. First the point arrays, then
   * those of the field data, each in the order of the output; i is 0 to GetNumberOfOutputArrays() - 1. For another i
   * the texts are nullptr, the association is -1 and the number 0.
   */
  static int GetNumberOfOutputArrays();
  static const char* GetOutputArrayName(int i);
  static int GetOutputArrayAssociation(int i);
  static int GetOutputArrayNumberOfComponents(int i);
  static const char* GetOutputArrayDescription(int i);
  ///@}

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

  ///@{
  /**
   * What is contoured: the isovalues of the scalars, each once, what to say where there are none, the
   * blocks with their scalars and what of these is contoured, and a hash of all that the scalars are made of besides the input. Other fields than arrays override them.
   */
  virtual std::vector<double> FindIsovalues();
  virtual std::vector<hop::UserMessage> CheckIsovalues(const hop::GatheredBlocks& gathered);
  virtual hop::CheckedBlocks FindScalars(const hop::GatheredBlocks& gathered);
  virtual void AddField(hop::ByteHash& hash);
  ///@}

  ///@{
  /**
   * What a run reads, the run itself, and what is told of it, apart from surfaces that are nowhere. Fields that take several runs override
   * them.
   */
  virtual hop::RunProperties PropertiesOfRun();
  virtual void Run(vtkDataObject* input, vtkDataObject* output);
  bool HasRunFailed() const { return this->HasFailed; }
  virtual void Tell(const std::vector<hop::UserMessage>& messages);
  virtual void ReviewSurfaces(const hop::InputBlocks& blocks, const std::vector<double>& isovalues,
    const std::vector<std::int64_t>& counts, bool isExplained);
  ///@}

private:
  vtkHighOrderParticleIsosurface(const vtkHighOrderParticleIsosurface&) = delete;
  void operator=(const vtkHighOrderParticleIsosurface&) = delete;

  bool IsAskedForMore(vtkInformationVector* outputs);
  void Answer(vtkDataObject* input, vtkDataObject* output);
  int KindOfOutput() const;
  std::uint64_t HashOfRequest(vtkDataObject* input);
  hop::RunCaller CallerOfRun();
  bool Accepts(const hop::GatheredBlocks& gathered, const hop::RunProperties& properties,
    const hop::RunScale& scale);

  vtkNew<vtkContourValues> ContourValues;
  double Spacing = 0.0;
  double AngularDensity = 10.0;
  double SmallestSpacing = 0.0;
  double Tolerance = 1e-10;
  int Component = VTK_INT_MAX;
  int Quantity = VALUE;
  std::string Expression;
  int Derivatives = IN_EACH_CELL;
  int NodeSpacing = UNIFORM;
  int Method = FAST;
  int Quality = STANDARD;
  int Seed = 1;
  vtkIdType NumberOfParticles = 0;
  vtkIdType ParticlesPerWorker = 0;
  bool WarmStart = false;
  bool PassDiagnostics = false;
  bool PassDerivatives = false;
  int OutputType = PARTICLES;
  int Order = 2;
  std::unique_ptr<hop::PreviousRun> Previous;
  std::unique_ptr<hop::KeptOutput> Kept;
  /** Whether the run at hand told an error: its output is not kept, for memory may suffice the next time. */
  bool HasFailed = false;
  /** Time of the last abort, 0 if the last run was not aborted. An abort ends its run and every repetition of this
   * run: ParaView asks for an aborted output again and again. Once something has changed, the filter lowers the flag,
   * which ParaView 6.1 never does. */
  vtkTimeStamp LastAbort;
  /** The time step of the aborted run. */
  double AbortedTime = 0.0;
};

#endif
