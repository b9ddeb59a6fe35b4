// Plays .sweep faces from C#: Unity, Godot, .NET. This file and the shared library of the C interface are all that is
// needed (docs/csharp.md). What docs/c-interface.md says of handles and threads holds here as well.
//
// With SWEEPFACE_CLIPS defined it calls libsweepface_clips instead, which reads clips, too.
#pragma warning disable 8600, 8601, 8602, 8603, 8604, 8618, 8625  // where null is allowed, comments say so
using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;
using System.Text;

namespace Sweepface
{
    /// <summary>What was asked for cannot be done; the message says why and what to do.</summary>
    public sealed class SweepfaceException : Exception
    {
        internal SweepfaceException(string message) : base(message) { }
    }

    /// <summary>How a weight moves to a goal (docs/motion.md).</summary>
    public enum DriveKind { Cut, Newton, LinearForce, AccelerateBrake, Spring, Bounce }

    /// <summary>A drive and its numbers; <see cref="Of"/> has the defaults.</summary>
    [Serializable]
    [StructLayout(LayoutKind.Sequential)]
    public struct Drive
    {
        public DriveKind Kind;
        /// <summary>Seconds before it sets out.</summary>
        public double Delay;
        /// <summary>Until it arrives; not for Cut and Spring.</summary>
        public double Seconds;
        /// <summary>AccelerateBrake: when the second force takes over, as a fraction of Seconds.</summary>
        public double Turn;
        /// <summary>Spring: oscillations a second without the damper; a Damping below 1 overshoots.</summary>
        public double Frequency, Damping;
        /// <summary>Bounce: the share of the speed kept at each bounce.</summary>
        public double Restitution;

        public static Drive Of(DriveKind kind) => Native.sweepface_drive_of((int)kind);
    }

    /// <summary>Angles in radians, right-handed: yaw to the face's left, pitch down, roll to its right.</summary>
    [Serializable]
    [StructLayout(LayoutKind.Sequential)]
    public struct Angles
    {
        public double Yaw, Pitch, Roll;

        /// <summary>Writes x, y, z and w of the quaternion that turns the model by them.</summary>
        public void Quaternion(double[] to)
        {
            Native.NeedRoom(to, 4, nameof(to));
            Native.sweepface_rotation(ref this, to);
        }
    }

    /// <summary>How head and eyes stand (docs/eyes.md).</summary>
    [Serializable]
    [StructLayout(LayoutKind.Sequential)]
    public struct HeadPose
    {
        public Angles Head, LeftEye, RightEye;
    }

    /// <summary>Weights that follow from those that are set (docs/arcs.md). Arcs needs a file made with `convert
    /// --arcs` (see FaceRig.TurnCount).</summary>
    [Flags]
    public enum Following { None = 0, Arcs = 1, Combine = 2 }

    /// <summary>Where a part of the face is: everything that is named, and what is near it (docs/regions.md).</summary>
    [Serializable]
    public sealed class Brush
    {
        /// <summary>Materials and groups of the source.</summary>
        public string[] Parts = {};
        /// <summary>[points x 3] separate places, in model units; a line through places.</summary>
        public double[] Points = {}, Line = {};
        /// <summary>Curves of the wireframe, by name or number.</summary>
        public string[] Curves = {};
        /// <summary>Single nodes, by name or number, and the exact shares they get.</summary>
        public string[] Nodes = {};
        public double[] NodeShares = {};
        /// <summary>All of the surface up to the first distance; beyond it, less and less over the second.</summary>
        public double Whole, Fade;
        /// <summary>Distances straight through space, not along the surface.</summary>
        public bool ThroughSpace;
    }

    /// <summary>How a region moves: its mass and stiffness relative to the rest, which has 1, and how many seconds later
    /// it sets out.</summary>
    [Serializable]
    [StructLayout(LayoutKind.Sequential)]
    public struct Matter
    {
        public double Mass, Stiffness, Delay;
    }

    /// <summary>Triangles of one material.</summary>
    [Serializable]
    public struct FacePart
    {
        public string Material;
        public int FirstTriangle, TriangleCount;
    }

    /// <summary>What a file holds. Any number of threads may read it; Follow, TurnEyes and Divide change it.</summary>
    public sealed partial class FaceRig : IDisposable
    {
        internal readonly Handle Handle;

        /// <summary>Reads a .sweep file within about `memory` bytes. Messages call it by the name, which may be
        /// null.</summary>
        public FaceRig(byte[] bytes, string name = null, long memory = 1L << 31)
        {
            if (bytes == null) throw new ArgumentNullException(nameof(bytes));
            if (memory <= 0) throw new ArgumentOutOfRangeException(nameof(memory));
            Native.CheckVersion();
            UIntPtr most = IntPtr.Size == 4 ? (UIntPtr)(uint)Math.Min(memory, uint.MaxValue) : (UIntPtr)(ulong)memory;
            Native.Check(Native.sweepface_rig_load_within(bytes, (UIntPtr)bytes.Length, Native.Text(name), most,
                                                          out IntPtr rig));
            Handle = new Handle(rig, Native.sweepface_rig_free);
            TargetNames = new string[Native.sweepface_rig_target_count(Handle)];
            for (int k = 0; k < TargetNames.Length; ++k)
                TargetNames[k] = Native.String(Native.sweepface_rig_target_name(Handle, (uint)k));
            GC.KeepAlive(this);
        }

        /// <summary>The expressions.</summary>
        public string[] TargetNames { get; }

        /// <summary>The number of a target; the exception lists the names there are.</summary>
        public int Find(string name)
        {
            Native.Check(Native.sweepface_rig_find_target(Handle, Native.Text(name), out uint target));
            return (int)target;
        }

        /// <summary>The targets that a tracker's name drives: EyeBlinkLeft drives eyeBlink_L.</summary>
        public int[] Match(string name)
        {
            byte[] text = Native.Text(name);
            var targets = new int[Native.sweepface_rig_match_targets(Handle, text, null, 0)];
            Native.sweepface_rig_match_targets(Handle, text, targets, (uint)targets.Length);
            return targets;
        }

        /// <summary>How many targets the file says turn about something: those that Arcs moves.</summary>
        public int TurnCount => (int)Native.sweepface_rig_turn_count(Handle);

        /// <summary>Lets weights follow from others; before the rig has meshes.</summary>
        public void Follow(Following what) => Native.Check(Native.sweepface_rig_follow(Handle, (uint)what));

        /// <summary>Makes eyeballs turn rigidly; after Follow and before the rig has meshes. Returns how many there
        /// are.</summary>
        public int TurnEyes()
        {
            Native.Check(Native.sweepface_rig_turn_eyes(Handle, out uint eyes));
            return (int)eyes;
        }

        /// <summary>The nodes of the wireframe, between which regions divide the face.</summary>
        public int NodeCount => (int)Native.sweepface_rig_node_count(Handle);

        /// <summary>How much of each node a brush paints, [nodes] from 0 to 1; or [bands x nodes] of neighbouring bands,
        /// from what it takes wholly to what lies beyond its fade.</summary>
        public double[] Paint(Brush brush, int bands = 1)
        {
            if (brush == null) throw new ArgumentNullException(nameof(brush));
            if (bands < 1 || bands > 32) throw new ArgumentOutOfRangeException(nameof(bands));
            var shares = new double[bands * NodeCount];
            using (var pins = new Pins())
            {
                var told = new Native.BrushIn(brush, pins);
                Native.Check(Native.sweepface_rig_paint(Handle, ref told, (uint)bands, shares, (UIntPtr)shares.Length));
            }
            return shares;
        }

        /// <summary>Divides the face into painted regions with weights of their own, shares [names x nodes], for meshes
        /// made from now on; none: one region again. What is left becomes a first region, "rest".</summary>
        public void Divide(string[] names, double[] shares)
        {
            if (names == null) throw new ArgumentNullException(nameof(names));
            if (shares == null) throw new ArgumentNullException(nameof(shares));
            if (shares.Length != (long)names.Length * NodeCount)
                throw new ArgumentException("There must be " + NodeCount + " shares for each region.", nameof(shares));
            using (var pins = new Pins())
                Native.Check(Native.sweepface_rig_divide(Handle, pins.Of(names), shares, (UIntPtr)names.Length));
        }

        /// <summary>The regions, by which weights are counted; a single null if the face is not divided.</summary>
        public string[] RegionNames
        {
            get
            {
                var names = new string[Native.sweepface_rig_region_count(Handle)];
                for (int k = 0; k < names.Length; ++k)
                    names[k] = Native.String(Native.sweepface_rig_region_name(Handle, (uint)k));
                GC.KeepAlive(this);
                return names;
            }
        }

        /// <summary>How far any vertex may be off in any expression, in model units.</summary>
        public double Tolerance => Native.sweepface_rig_tolerance(Handle);

        /// <summary>The corners of the neutral's box, in model units.</summary>
        public void Box(out double[] low, out double[] high)
        {
            low = new double[3];
            high = new double[3];
            Native.sweepface_rig_box(Handle, low, high);
        }

        public void Dispose() => Handle.Dispose();
    }

    /// <summary>What a level of detail may cost or must achieve (docs/evaluation.md).</summary>
    public enum Budget { EdgeLength, Error, Vertices }

    /// <summary>The surface at one level of detail. Any number of threads may read it.</summary>
    public sealed class FaceMesh : IDisposable
    {
        internal readonly Handle Handle;

        /// <summary>0: the source's own vertices; N: every edge of the source cut into N.</summary>
        public FaceMesh(FaceRig rig, int lod = 0)
        {
            Native.Check(Native.sweepface_mesh_create(HandleOf(rig), Native.Index(lod, nameof(lod)), out IntPtr mesh));
            Handle = new Handle(mesh, Native.sweepface_mesh_free);
        }

        /// <summary>As fine as a budget demands, without cracks.</summary>
        public FaceMesh(FaceRig rig, Budget budget, double value)
        {
            Native.Check(Native.sweepface_mesh_create_within(HandleOf(rig), (int)budget, value, out IntPtr mesh));
            Handle = new Handle(mesh, Native.sweepface_mesh_free);
        }

        /// <summary>The places of the surface nearest to points [count x 3] in the neutral, for things attached to the
        /// face.</summary>
        public FaceMesh(FaceRig rig, double[] points)
        {
            if (points == null) throw new ArgumentNullException(nameof(points));
            if (points.Length % 3 != 0) throw new ArgumentException("Points are three numbers each.", nameof(points));
            var count = (UIntPtr)(points.Length / 3);
            Native.Check(Native.sweepface_mesh_create_at(HandleOf(rig), points, count, out IntPtr mesh));
            Handle = new Handle(mesh, Native.sweepface_mesh_free);
        }

        static Handle HandleOf(FaceRig rig) => (rig ?? throw new ArgumentNullException(nameof(rig))).Handle;

        /// <summary>Builds the tables that move it now rather than in the first frame that needs them.</summary>
        public void Prepare(bool normals = true, bool tangents = false)
        {
            Native.Check(Native.sweepface_mesh_prepare(Handle, normals ? 1 : 0));
            if (tangents) Native.Check(Native.sweepface_mesh_prepare_tangents(Handle));
        }

        /// <summary>Vertices are first the points, then copies of points with other texture coordinates.</summary>
        public int PointCount => (int)Native.sweepface_mesh_point_count(Handle);
        public int VertexCount => (int)Native.sweepface_mesh_vertex_count(Handle);
        public int TriangleCount => (int)Native.sweepface_mesh_triangle_count(Handle);

        /// <summary>The regions for which its faces have weights.</summary>
        public int RegionCount => (int)Native.sweepface_mesh_region_count(Handle);

        // What follows is copied each time.

        /// <summary>The point that each vertex after the points repeats.</summary>
        public int[] Copies => Ints(Native.sweepface_mesh_copies(Handle), VertexCount - PointCount);

        /// <summary>[triangles x 3] counter-clockwise seen from outside, part by part.</summary>
        public int[] Triangles => Ints(Native.sweepface_mesh_triangles(Handle), 3 * TriangleCount);

        /// <summary>[vertices x 2] u to the right and v upwards, or null.</summary>
        public float[] Texcoords
        {
            get
            {
                IntPtr first = Native.sweepface_mesh_texcoords(Handle);
                if (first == IntPtr.Zero) return null;
                var texcoords = new float[2 * VertexCount];
                Marshal.Copy(first, texcoords, 0, texcoords.Length);
                GC.KeepAlive(this);
                return texcoords;
            }
        }

        /// <summary>Triangles by their materials.</summary>
        public FacePart[] Parts
        {
            get
            {
                var parts = new FacePart[Native.sweepface_mesh_part_count(Handle)];
                for (int k = 0; k < parts.Length; ++k)
                {
                    Native.Check(Native.sweepface_mesh_part(Handle, (uint)k, out Native.PartOut part));
                    parts[k] = new FacePart
                    {
                        Material = Native.String(part.Material),
                        FirstTriangle = (int)part.FirstTriangle,
                        TriangleCount = (int)part.TriangleCount
                    };
                }
                GC.KeepAlive(this);
                return parts;
            }
        }

        /// <summary>Between which of the source's vertices the points lie, for their skin weights or colours: four
        /// vertices and shares of each point.</summary>
        public void Origins(out int[] sources, out float[] shares)
        {
            sources = new int[4 * PointCount];
            shares = new float[4 * PointCount];
            Native.Check(Native.sweepface_mesh_origins(Handle, (UIntPtr)PointCount, sources, shares));
        }

        public void Dispose() => Handle.Dispose();

        int[] Ints(IntPtr first, int count)
        {
            var numbers = new int[count];
            if (count > 0) Marshal.Copy(first, numbers, 0, count);
            GC.KeepAlive(this);
            return numbers;
        }
    }

    /// <summary>A set of weights on a mesh, for one thread at a time. Evaluating allocates nothing once the mesh is
    /// prepared.</summary>
    public sealed class Face : IDisposable
    {
        readonly Handle handle;
        readonly int vertices;
        readonly HeadPose[] pose = new HeadPose[1];

        /// <summary>Shows the neutral: all weights are 0.</summary>
        public Face(FaceMesh mesh)
        {
            if (mesh == null) throw new ArgumentNullException(nameof(mesh));
            Native.Check(Native.sweepface_face_create(mesh.Handle, out IntPtr face));
            handle = new Handle(face, Native.sweepface_face_free);
            vertices = mesh.VertexCount;
        }

        public void SetWeight(int target, double weight) =>
            Native.Check(Native.sweepface_face_set_weight(handle, Native.Index(target, nameof(target)), weight));

        /// <summary>Sets the first weights, in all regions.</summary>
        public void SetWeights(double[] weights) =>
            Native.Check(Native.sweepface_face_set_weights(handle, weights, Native.Count(weights)));

        /// <summary>Sets the first weights in one region.</summary>
        public void SetWeights(int region, double[] weights) =>
            Native.Check(Native.sweepface_face_set_region_weights(handle, Native.Index(region, nameof(region)), weights,
                                                                  Native.Count(weights)));

        /// <summary>Writes positions, and normals unless null, of all vertices: [vertices x 3] each.</summary>
        public void Evaluate(float[] positions, float[] normals = null)
        {
            CheckRoom(positions, 3, nameof(positions));
            CheckRoom(normals, 3, nameof(normals));
            EvaluateInto(positions, normals);
        }

        /// <summary>The same to vectors of three floats each: those of Unity, Godot or System.Numerics.</summary>
        public void Evaluate<T>(T[] positions, T[] normals = null) where T : struct
        {
            if (Marshal.SizeOf<T>() != 12) throw new ArgumentException("A vector must be three floats.");
            if (positions?.Length < vertices || normals?.Length < vertices)
                throw new ArgumentException("There are " + vertices + " vertices to write.");
            EvaluateInto(positions, normals);
        }

        void EvaluateInto(Array positions, Array normals)
        {
            using (var to = new Pinned(positions, normals))
                Native.Check(Native.sweepface_face_evaluate(handle, (UIntPtr)vertices, to.First, to.Second));
        }

        /// <summary>The same into other memory: the first `count` vertices, `stride` bytes apart; IntPtr.Zero: not
        /// wanted. It must have room for them.</summary>
        public void Evaluate(int count, IntPtr positions, IntPtr normals, int stride = 12) =>
            Native.Check(Native.sweepface_face_evaluate(handle, (UIntPtr)Native.Index(count, nameof(count)),
                                                        new Native.Vectors(positions, stride),
                                                        new Native.Vectors(normals, stride)));

        /// <summary>The same for memory that still holds what the last call wrote there: only what the weights have
        /// moved since is written again. Call Evaluate the first time with any memory: new memory may be where older
        /// was.</summary>
        public void Update(int count, IntPtr positions, IntPtr normals, int stride = 12) =>
            Native.Check(Native.sweepface_face_update(handle, (UIntPtr)Native.Index(count, nameof(count)),
                                                      new Native.Vectors(positions, stride),
                                                      new Native.Vectors(normals, stride)));

        /// <summary>Writes the tangent space of normal maps: normals [vertices x 3], tangents [vertices x 4].</summary>
        public void Tangents(float[] normals, float[] tangents)
        {
            CheckRoom(normals, 3, nameof(normals));
            CheckRoom(tangents, 4, nameof(tangents));
            using (var to = new Pinned(normals, tangents))
                Native.Check(Native.sweepface_face_tangents(handle, (UIntPtr)vertices, to.First, to.Second));
        }

        /// <summary>The corners of a box that contains the face under its weights, for culling.</summary>
        public void Box(double[] low, double[] high)
        {
            Native.NeedRoom(low, 3, nameof(low));
            Native.NeedRoom(high, 3, nameof(high));
            Native.Check(Native.sweepface_face_box(handle, low, high));
        }

        /// <summary>How far any vertex may be from the exact surface now, in model units. Not for every
        /// frame.</summary>
        public double Error => Native.sweepface_face_error(handle);

        /// <summary>Turns the eyes to these angles; null: by the weights of eyeLook targets.</summary>
        public void Look(HeadPose? angles)
        {
            pose[0] = angles.GetValueOrDefault();
            Native.Check(Native.sweepface_face_look(handle, angles.HasValue ? pose : null));
        }

        public void Dispose() => handle.Dispose();

        void CheckRoom(float[] array, int each, string name)
        {
            if (array != null && array.Length < (long)each * vertices)
                throw new ArgumentException(each + " floats are written for each of " + vertices + " vertices.", name);
        }
    }

    /// <summary>Weights in motion, for one thread at a time: they take new goals at any instant and go on from where
    /// they are.</summary>
    public sealed class FaceMotion : IDisposable
    {
        readonly Handle handle;
        readonly Drive[] told = new Drive[1];

        /// <summary>At rest at these weights.</summary>
        public FaceMotion(double[] weights)
        {
            Native.CheckVersion();
            Native.Check(Native.sweepface_motion_create(weights, Native.Count(weights), out IntPtr motion));
            handle = new Handle(motion, Native.sweepface_motion_free);
        }

        /// <summary>The same for regions: what moves a weight moves it in all, in each by its matter. Positions and
        /// velocities are then [regions x weights].</summary>
        public FaceMotion(double[] weights, Matter[] matters)
        {
            if (matters == null) throw new ArgumentNullException(nameof(matters));
            Native.CheckVersion();
            Native.Check(Native.sweepface_motion_create_regions(weights, Native.Count(weights), matters,
                                                                (UIntPtr)matters.Length, out IntPtr motion));
            handle = new Handle(motion, Native.sweepface_motion_free);
        }

        FaceMotion(IntPtr motion) { handle = new Handle(motion, Native.sweepface_motion_free); }

        /// <summary>A second motion in the same state, independent from then on.</summary>
        public FaceMotion Copy()
        {
            Native.Check(Native.sweepface_motion_copy(handle, out IntPtr copy));
            return new FaceMotion(copy);
        }

        /// <summary>Lets time pass.</summary>
        public void Advance(double seconds) => Native.sweepface_motion_advance(handle, seconds);

        /// <summary>Sends a weight to a goal, by a critically damped spring if drive is null.</summary>
        public void MoveTo(int weight, double goal, Drive? drive = null) =>
            Native.Check(Native.sweepface_motion_move_to(handle, Native.Index(weight, nameof(weight)), goal,
                                                         DriveOf(drive)));

        /// <summary>Sends all weights to goals, one each.</summary>
        public void MoveTo(double[] goals, Drive? drive = null) =>
            Native.Check(Native.sweepface_motion_move_all(handle, goals, Native.Count(goals), DriveOf(drive)));

        /// <summary>Sends a weight to a goal in one region.</summary>
        public void MoveIn(int region, int weight, double goal, Drive? drive = null) =>
            Native.Check(Native.sweepface_motion_move_in(handle, Native.Index(region, nameof(region)),
                                                         Native.Index(weight, nameof(weight)), goal, DriveOf(drive)));

        /// <summary>Puts a weight somewhere in one region, at once and without its delay.</summary>
        public void PutIn(int region, int weight, double value) =>
            Native.Check(Native.sweepface_motion_put_in(handle, Native.Index(region, nameof(region)),
                                                        Native.Index(weight, nameof(weight)), value));

        Drive[] DriveOf(Drive? drive)
        {
            told[0] = drive.GetValueOrDefault();
            return drive.HasValue ? told : null;
        }

        /// <summary>An impulse: adds to a velocity, which drag (per second) then takes away.</summary>
        public void Push(int weight, double velocityChange, double drag) =>
            Native.Check(Native.sweepface_motion_push(handle, Native.Index(weight, nameof(weight)), velocityChange,
                                                      drag));

        /// <summary>Fills the array with the first weights; it may not be longer than there are weights.</summary>
        public void Positions(double[] weights) =>
            Native.Check(Native.sweepface_motion_positions(handle, weights, Native.Count(weights)));
        public void Velocities(double[] velocities) =>
            Native.Check(Native.sweepface_motion_velocities(handle, velocities, Native.Count(velocities)));

        /// <summary>Whether any weight may still be further than that from where it comes to rest.</summary>
        public bool Moves(double tolerance = 0.001) => Native.sweepface_motion_moves(handle, tolerance) != 0;

        public void Dispose() => handle.Dispose();
    }

#if SWEEPFACE_CLIPS
    public sealed partial class FaceRig
    {
        /// <summary>Divides the face by the regions of a JSON text, which may be a timeline, for meshes made from now
        /// on. Messages call it by the name, which may be null.</summary>
        public void Divide(byte[] text, string name = null)
        {
            if (text == null) throw new ArgumentNullException(nameof(text));
            Native.Check(Native.sweepface_rig_divide_by(Handle, text, (UIntPtr)text.Length, Native.Text(name)));
        }

        /// <summary>How a region moves, as that text says.</summary>
        public Matter MatterOf(int region)
        {
            Native.Check(Native.sweepface_rig_region_matter(Handle, Native.Index(region, nameof(region)),
                                                            out Matter matter));
            return matter;
        }
    }

    /// <summary>A recording or a timeline for the targets of a rig (docs/clips.md). Any number of threads may read
    /// it.</summary>
    public sealed class FaceClip : IDisposable
    {
        readonly Handle handle;

        /// <summary>Reads a capture of Live Link Face, Audio2Face or MediaPipe, a timeline or an animation of a .glb.
        /// `framesPerSecond` is that of captures that do not tell; `smooth` removes a tracker's noise; `animation` is
        /// the name of one of several in a .glb, or null; `names` is a JSON text for targets that are called
        /// otherwise, or null.</summary>
        public FaceClip(FaceRig rig, byte[] bytes, string name = null, double framesPerSecond = 0, bool smooth = false,
                        string animation = null, string names = null)
        {
            if (rig == null) throw new ArgumentNullException(nameof(rig));
            if (bytes == null) throw new ArgumentNullException(nameof(bytes));
            Native.ClipOptions options = Native.sweepface_clip_usual_options();
            options.FramesPerSecond = framesPerSecond;
            options.Smooth = smooth ? 1 : 0;
            using (var texts = new Pinned(Native.Text(animation), Native.Text(names)))
            {
                options.Animation = texts.First.Data;
                options.Names = texts.Second.Data;
                Native.Check(Native.sweepface_clip_read(rig.Handle, bytes, (UIntPtr)bytes.Length, Native.Text(name),
                                                        ref options, out IntPtr clip));
                handle = new Handle(clip, Native.sweepface_clip_free);
            }
        }

        public double Seconds => Native.sweepface_clip_seconds(handle);

        /// <summary>Names of the clip that drive no target.</summary>
        public string[] Unmatched => Strings(Native.sweepface_clip_unmatched);
        /// <summary>Targets that nothing drives.</summary>
        public string[] Undriven => Strings(Native.sweepface_clip_undriven);
        /// <summary>What was repaired or may be wrong in the file.</summary>
        public string[] Warnings => Strings(Native.sweepface_clip_warning);

        /// <summary>The regions that the rig had when the clip was read.</summary>
        public int RegionCount => (int)Native.sweepface_clip_region_count(handle);

        /// <summary>Fills the array with the first of the weights [regions x targets], `seconds` after the first
        /// frame.</summary>
        public void Weights(double seconds, double[] weights) =>
            Native.Check(Native.sweepface_clip_weights(handle, seconds, weights, Native.Count(weights)));

        /// <summary>Whether there are angles of the head, and of eyes that ever turn.</summary>
        public bool HasHead => Native.sweepface_clip_has_head(handle) != 0;
        public bool HasEyes => Native.sweepface_clip_has_eyes(handle) != 0;

        /// <summary>All angles at a time.</summary>
        public HeadPose Pose(double seconds)
        {
            Native.Check(Native.sweepface_clip_pose(handle, seconds, out HeadPose pose));
            return pose;
        }

        public void Dispose() => handle.Dispose();

        string[] Strings(Func<Handle, uint, IntPtr> at)
        {
            var texts = new List<string>();
            for (string text; (text = Native.String(at(handle, (uint)texts.Count))) != null;) texts.Add(text);
            GC.KeepAlive(this);
            return texts.ToArray();
        }
    }
#endif

    /// <summary>A handle of the C interface, freed once, whoever lets go of it last.</summary>
    sealed class Handle : SafeHandle
    {
        readonly Action<IntPtr> free;

        internal Handle(IntPtr value, Action<IntPtr> free) : base(IntPtr.Zero, true)
        {
            this.free = free;
            SetHandle(value);
        }

        public override bool IsInvalid => handle == IntPtr.Zero;

        protected override bool ReleaseHandle()
        {
            free(handle);
            return true;
        }
    }

    /// <summary>Arrays and texts that stay where they are while they are read.</summary>
    sealed class Pins : IDisposable
    {
        readonly List<GCHandle> pins = new List<GCHandle>();

        internal IntPtr Of(Array array)
        {
            if (array == null) return IntPtr.Zero;
            pins.Add(GCHandle.Alloc(array, GCHandleType.Pinned));
            return pins[pins.Count - 1].AddrOfPinnedObject();
        }

        internal IntPtr[] Of(string[] texts) =>
            texts == null ? null : Array.ConvertAll(texts, text => Of(Native.Text(text)));

        public void Dispose()
        {
            foreach (GCHandle pin in pins) pin.Free();
        }
    }

    /// <summary>Two arrays that stay where they are while they are written to.</summary>
    struct Pinned : IDisposable
    {
        GCHandle first, second;

        internal Pinned(Array first, Array second)
        {
            this.first = first == null ? default(GCHandle) : GCHandle.Alloc(first, GCHandleType.Pinned);
            this.second = second == null ? default(GCHandle) : GCHandle.Alloc(second, GCHandleType.Pinned);
        }

        internal Native.Vectors First => VectorsOf(first);
        internal Native.Vectors Second => VectorsOf(second);

        static Native.Vectors VectorsOf(GCHandle pin) =>
            new Native.Vectors(pin.IsAllocated ? pin.AddrOfPinnedObject() : IntPtr.Zero, 0);

        public void Dispose()
        {
            if (first.IsAllocated) first.Free();
            if (second.IsAllocated) second.Free();
        }
    }

    /// <summary>The C interface as sweepface.h and the headers beside it declare it.</summary>
    static class Native
    {
#if !UNITY_EDITOR && (UNITY_IOS || UNITY_TVOS || UNITY_VISIONOS)
        const string Library = "__Internal";  // these link it statically
#elif SWEEPFACE_CLIPS
        const string Library = "sweepface_clips";
#else
        const string Library = "sweepface";
#endif
        const CallingConvention C = CallingConvention.Cdecl;

        [StructLayout(LayoutKind.Sequential)]
        internal struct Vectors
        {
            internal readonly IntPtr Data;
            readonly UIntPtr stride;

            internal Vectors(IntPtr data, int stride)
            {
                Data = data;
                this.stride = (UIntPtr)Index(stride, nameof(stride));
            }
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct BrushIn
        {
            readonly IntPtr parts;
            readonly UIntPtr partCount;
            readonly IntPtr points;
            readonly UIntPtr pointCount;
            readonly IntPtr line;
            readonly UIntPtr lineCount;
            readonly IntPtr curves;
            readonly UIntPtr curveCount;
            readonly IntPtr nodes, nodeShares;
            readonly UIntPtr nodeCount;
            readonly double whole, fade;
            readonly int throughSpace;

            internal BrushIn(Brush brush, Pins pins)
            {
                if ((brush.Points?.Length ?? 0) % 3 != 0 || (brush.Line?.Length ?? 0) % 3 != 0)
                    throw new ArgumentException("Places are three numbers each.");
                if ((brush.Nodes?.Length ?? 0) != (brush.NodeShares?.Length ?? 0))
                    throw new ArgumentException("Each node needs a share.");
                parts = pins.Of(pins.Of(brush.Parts));
                partCount = Length(brush.Parts);
                points = pins.Of(brush.Points);
                pointCount = Length(brush.Points, 3);
                line = pins.Of(brush.Line);
                lineCount = Length(brush.Line, 3);
                curves = pins.Of(pins.Of(brush.Curves));
                curveCount = Length(brush.Curves);
                nodes = pins.Of(pins.Of(brush.Nodes));
                nodeShares = pins.Of(brush.NodeShares);
                nodeCount = Length(brush.Nodes);
                whole = brush.Whole;
                fade = brush.Fade;
                throughSpace = brush.ThroughSpace ? 1 : 0;
            }

            static UIntPtr Length(Array array, int each = 1) => (UIntPtr)((array?.Length ?? 0) / each);
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct PartOut
        {
            internal IntPtr Material;
            internal uint FirstTriangle, TriangleCount;
        }

        internal static void Check(int status)
        {
            if (status != 0) throw new SweepfaceException(String(sweepface_message()));
        }

        /// <summary>Before 1.0 every minor version is an interface of its own.</summary>
        internal static void CheckVersion()
        {
            uint version = sweepface_version();
            if (version / 100 != 1)
                throw new SweepfaceException("The library " + Library + " is version " + version / 10000 + "." +
                                             version / 100 % 100 + ", but Sweepface.cs is for 0.1; use those of one version.");
        }

        internal static uint Index(int index, string name) =>
            index >= 0 ? (uint)index : throw new ArgumentOutOfRangeException(name);

        internal static UIntPtr Count(double[] numbers) =>
            (UIntPtr)(numbers ?? throw new ArgumentNullException(nameof(numbers))).Length;

        internal static void NeedRoom(double[] to, int count, string name)
        {
            if (to == null || to.Length < count) throw new ArgumentException(count + " numbers are written.", name);
        }

        /// <summary>A text as C reads it: UTF-8, ended by 0.</summary>
        internal static byte[] Text(string text) => text == null ? null : Encoding.UTF8.GetBytes(text + "\0");

        internal static string String(IntPtr text)
        {
            if (text == IntPtr.Zero) return null;
            int length = 0;
            while (Marshal.ReadByte(text, length) != 0) ++length;
            var bytes = new byte[length];
            Marshal.Copy(text, bytes, 0, length);
            return Encoding.UTF8.GetString(bytes);
        }

        [DllImport(Library, CallingConvention = C)] static extern IntPtr sweepface_message();
        [DllImport(Library, CallingConvention = C)] static extern uint sweepface_version();
        [DllImport(Library, CallingConvention = C)] internal static extern void sweepface_rotation(ref Angles angles, [Out] double[] quaternion);

        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_rig_load_within(byte[] bytes, UIntPtr size, byte[] name, UIntPtr memory, out IntPtr rig);
        [DllImport(Library, CallingConvention = C)] internal static extern void sweepface_rig_free(IntPtr rig);
        [DllImport(Library, CallingConvention = C)] internal static extern uint sweepface_rig_target_count(Handle rig);
        [DllImport(Library, CallingConvention = C)] internal static extern IntPtr sweepface_rig_target_name(Handle rig, uint target);
        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_rig_find_target(Handle rig, byte[] name, out uint target);
        [DllImport(Library, CallingConvention = C)] internal static extern uint sweepface_rig_match_targets(Handle rig, byte[] name, [Out] int[] targets, uint room);
        [DllImport(Library, CallingConvention = C)] internal static extern uint sweepface_rig_turn_count(Handle rig);
        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_rig_follow(Handle rig, uint what);
        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_rig_turn_eyes(Handle rig, out uint eyes);
        [DllImport(Library, CallingConvention = C)] internal static extern double sweepface_rig_tolerance(Handle rig);
        [DllImport(Library, CallingConvention = C)] internal static extern uint sweepface_rig_node_count(Handle rig);
        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_rig_paint(Handle rig, ref BrushIn brush, uint bands, [Out] double[] shares, UIntPtr count);
        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_rig_divide(Handle rig, IntPtr[] names, double[] shares, UIntPtr count);
        [DllImport(Library, CallingConvention = C)] internal static extern uint sweepface_rig_region_count(Handle rig);
        [DllImport(Library, CallingConvention = C)] internal static extern IntPtr sweepface_rig_region_name(Handle rig, uint region);
        [DllImport(Library, CallingConvention = C)] internal static extern void sweepface_rig_box(Handle rig, [Out] double[] low, [Out] double[] high);

        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_mesh_create(Handle rig, uint lod, out IntPtr mesh);
        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_mesh_create_within(Handle rig, int budget, double value, out IntPtr mesh);
        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_mesh_create_at(Handle rig, double[] points, UIntPtr count, out IntPtr mesh);
        [DllImport(Library, CallingConvention = C)] internal static extern void sweepface_mesh_free(IntPtr mesh);
        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_mesh_prepare(Handle mesh, int normals);
        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_mesh_prepare_tangents(Handle mesh);
        [DllImport(Library, CallingConvention = C)] internal static extern uint sweepface_mesh_region_count(Handle mesh);
        [DllImport(Library, CallingConvention = C)] internal static extern uint sweepface_mesh_point_count(Handle mesh);
        [DllImport(Library, CallingConvention = C)] internal static extern uint sweepface_mesh_vertex_count(Handle mesh);
        [DllImport(Library, CallingConvention = C)] internal static extern IntPtr sweepface_mesh_copies(Handle mesh);
        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_mesh_origins(Handle mesh, UIntPtr count, [Out] int[] vertices, [Out] float[] shares);
        [DllImport(Library, CallingConvention = C)] internal static extern uint sweepface_mesh_triangle_count(Handle mesh);
        [DllImport(Library, CallingConvention = C)] internal static extern IntPtr sweepface_mesh_triangles(Handle mesh);
        [DllImport(Library, CallingConvention = C)] internal static extern IntPtr sweepface_mesh_texcoords(Handle mesh);
        [DllImport(Library, CallingConvention = C)] internal static extern uint sweepface_mesh_part_count(Handle mesh);
        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_mesh_part(Handle mesh, uint part, out PartOut found);

        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_face_create(Handle mesh, out IntPtr face);
        [DllImport(Library, CallingConvention = C)] internal static extern void sweepface_face_free(IntPtr face);
        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_face_set_weight(Handle face, uint target, double weight);
        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_face_set_weights(Handle face, double[] weights, UIntPtr count);
        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_face_set_region_weights(Handle face, uint region, double[] weights, UIntPtr count);
        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_face_evaluate(Handle face, UIntPtr count, Vectors positions, Vectors normals);
        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_face_update(Handle face, UIntPtr count, Vectors positions, Vectors normals);
        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_face_tangents(Handle face, UIntPtr count, Vectors normals, Vectors tangents);
        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_face_box(Handle face, [Out] double[] low, [Out] double[] high);
        [DllImport(Library, CallingConvention = C)] internal static extern double sweepface_face_error(Handle face);
        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_face_look(Handle face, [In] HeadPose[] pose);

        [DllImport(Library, CallingConvention = C)] internal static extern Drive sweepface_drive_of(int kind);
        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_motion_create(double[] weights, UIntPtr count, out IntPtr motion);
        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_motion_create_regions(double[] weights, UIntPtr count, [In] Matter[] matters, UIntPtr regions, out IntPtr motion);
        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_motion_copy(Handle motion, out IntPtr copy);
        [DllImport(Library, CallingConvention = C)] internal static extern void sweepface_motion_free(IntPtr motion);
        [DllImport(Library, CallingConvention = C)] internal static extern void sweepface_motion_advance(Handle motion, double seconds);
        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_motion_move_to(Handle motion, uint weight, double goal, [In] Drive[] drive);
        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_motion_move_all(Handle motion, double[] goals, UIntPtr count, [In] Drive[] drive);
        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_motion_move_in(Handle motion, uint region, uint weight, double goal, [In] Drive[] drive);
        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_motion_put_in(Handle motion, uint region, uint weight, double value);
        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_motion_push(Handle motion, uint weight, double velocityChange, double drag);
        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_motion_positions(Handle motion, [Out] double[] to, UIntPtr count);
        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_motion_velocities(Handle motion, [Out] double[] to, UIntPtr count);
        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_motion_moves(Handle motion, double tolerance);

#if SWEEPFACE_CLIPS
        [StructLayout(LayoutKind.Sequential)]
        internal struct ClipOptions
        {
            internal double FramesPerSecond;
            internal int Smooth;
            internal double Frequency, Damping;
            internal IntPtr Animation, Names;
        }

        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_rig_divide_by(Handle rig, byte[] text, UIntPtr size, byte[] name);
        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_rig_region_matter(Handle rig, uint region, out Matter matter);
        [DllImport(Library, CallingConvention = C)] internal static extern ClipOptions sweepface_clip_usual_options();
        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_clip_read(Handle rig, byte[] bytes, UIntPtr size, byte[] name, ref ClipOptions options, out IntPtr clip);
        [DllImport(Library, CallingConvention = C)] internal static extern void sweepface_clip_free(IntPtr clip);
        [DllImport(Library, CallingConvention = C)] internal static extern double sweepface_clip_seconds(Handle clip);
        [DllImport(Library, CallingConvention = C)] internal static extern IntPtr sweepface_clip_unmatched(Handle clip, uint index);
        [DllImport(Library, CallingConvention = C)] internal static extern IntPtr sweepface_clip_undriven(Handle clip, uint index);
        [DllImport(Library, CallingConvention = C)] internal static extern IntPtr sweepface_clip_warning(Handle clip, uint index);
        [DllImport(Library, CallingConvention = C)] internal static extern uint sweepface_clip_region_count(Handle clip);
        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_clip_weights(Handle clip, double seconds, [Out] double[] to, UIntPtr count);
        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_clip_has_head(Handle clip);
        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_clip_has_eyes(Handle clip);
        [DllImport(Library, CallingConvention = C)] internal static extern int sweepface_clip_pose(Handle clip, double seconds, out HeadPose pose);
#endif
    }
}
