// Plays a face through csharp/Sweepface.cs and compares it with what the tool exports.
// Usage: Plays FACE.sweep JAW_OPEN.obj TAKE.csv
using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Runtime.InteropServices;
using Sweepface;

static class Plays
{
    static int failures;

    static void Expect(bool holds, string what)
    {
        if (holds) return;
        ++failures;
        Console.WriteLine("failed: " + what);
    }

    static void Refuses<T>(Action action, string sentence) where T : Exception
    {
        try { action(); }
        catch (T refusal)
        {
            Expect(refusal.Message.Contains(sentence), "'" + refusal.Message + "' has '" + sentence + "'");
            return;
        }
        Expect(false, "refused with '" + sentence + "'");
    }

    static float[] VerticesOf(string obj) => (
        from line in File.ReadLines(obj)
        where line.StartsWith("v ", StringComparison.Ordinal)
        from number in line.Split(' ').Skip(1)
        select float.Parse(number, CultureInfo.InvariantCulture)).ToArray();

    static double Farthest(float[] a, float[] b, int count) =>
        Enumerable.Range(0, count).Max(k => Math.Abs((double)a[k] - b[k]));

    static void PlaysExpressions(FaceRig rig, string exported)
    {
        Expect(rig.TargetNames.Length == 42 && rig.TargetNames[rig.Find("jawOpen")] == "jawOpen", "names of targets");
        Expect(rig.Match("EyeBlink_L").Single() == rig.Find("eyeBlinkLeft"), "a tracker's name");
        Refuses<SweepfaceException>(() => rig.Find("frown"), "no target named 'frown'");
        using (var mesh = new FaceMesh(rig))
        using (var face = new Face(mesh))
        {
            rig.Dispose();  // the mesh keeps what it needs
            mesh.Prepare(tangents: true);
            var positions = new float[3 * mesh.VertexCount];
            var normals = new float[3 * mesh.VertexCount];
            face.SetWeight(Array.IndexOf(rig.TargetNames, "jawOpen"), 1);
            face.Evaluate(positions, normals);
            float[] expected = VerticesOf(exported);
            Expect(expected.Length == 3 * mesh.PointCount, "as many points as the source has vertices");
            Expect(Farthest(positions, expected, expected.Length) <= face.Error && face.Error < 0.01, "positions");
            Expect(Math.Abs(Length(normals, 17) - 1) < 1e-5, "unit normals");
            int[] copies = mesh.Copies;
            Expect(copies.Length == mesh.VertexCount - mesh.PointCount && copies.Length > 0, "copies");
            Expect(positions[3 * mesh.PointCount] == positions[3 * copies[0]], "copies are where their points are");
            Expect(mesh.Triangles.Length > 40000 && mesh.Triangles.Max() < mesh.VertexCount, "triangles");
            Expect(mesh.Texcoords.Length == 2 * mesh.VertexCount, "texture coordinates");
            Expect(mesh.Parts.Any(part => part.Material == "skin"), "materials");
            Expect(mesh.Parts.Sum(part => part.TriangleCount) == mesh.Triangles.Length / 3, "parts");
            var tangents = new float[4 * mesh.VertexCount];
            face.Tangents(normals, tangents);
            Expect(Math.Abs(tangents[3]) == 1, "signs of tangents");
            var low = new double[3];
            var high = new double[3];
            face.Box(low, high);
            Expect(Enumerable.Range(0, positions.Length).All(k => low[k % 3] <= positions[k] && positions[k] <= high[k % 3]),
                   "a box around the face");
            var vectors = new UnityEngine.Vector3[mesh.VertexCount];
            face.Evaluate(vectors);
            Expect(vectors[5].y == positions[16], "vectors");
            Refuses<ArgumentException>(() => face.Evaluate(new UnityEngine.Vector3[9]), "vertices to write");
            Refuses<ArgumentException>(() => face.Evaluate(new double[99999]), "three floats");
            Refuses<ArgumentException>(() => face.Evaluate(new float[9]), "3 floats are written for each of");
            Refuses<SweepfaceException>(() => face.SetWeight(42, 1), "42");
            IsPlayedIntoOtherMemory(face, mesh, positions);
            AllocatesNothing(face, positions, normals);
        }
        Refuses<ObjectDisposedException>(() => new FaceMesh(rig), "");
    }

    static double Length(float[] vectors, int k) => Math.Sqrt(
        vectors[3 * k] * vectors[3 * k] + vectors[3 * k + 1] * vectors[3 * k + 1] + vectors[3 * k + 2] * vectors[3 * k + 2]);

    static void IsPlayedIntoOtherMemory(Face face, FaceMesh mesh, float[] positions)
    {
        var vertices = new float[8 * mesh.VertexCount];  // position, normal, texture coordinate
        GCHandle pin = GCHandle.Alloc(vertices, GCHandleType.Pinned);
        try
        {
            IntPtr first = pin.AddrOfPinnedObject();
            face.Update(mesh.VertexCount, first, IntPtr.Add(first, 12), 32);
            Expect(Enumerable.Range(0, mesh.VertexCount).All(v => vertices[8 * v + 1] == positions[3 * v + 1]), "strides");
            Refuses<SweepfaceException>(() => face.Evaluate(mesh.VertexCount, first, IntPtr.Zero, 11), "stride");
            Refuses<SweepfaceException>(() => face.Evaluate(mesh.VertexCount + 1, first, IntPtr.Zero, 32), "vertices");
        }
        finally { pin.Free(); }
    }

    static void AllocatesNothing(Face face, float[] positions, float[] normals)
    {
        face.Evaluate(positions, normals);
        long before = GC.GetTotalMemory(true);
        for (int k = 0; k < 1000; ++k) face.Evaluate(positions, normals);
        Expect(GC.GetTotalMemory(false) - before < 10000, "no allocation in a frame");
    }

    static void ComesAtLevelsOfDetail(byte[] bytes)
    {
        using (var rig = new FaceRig(bytes))
        using (var coarse = new FaceMesh(rig, Budget.Vertices, 3000))
        using (var fine = new FaceMesh(rig, 2))
        {
            Expect(coarse.PointCount <= 3000 && fine.PointCount > 16000, "levels of detail");
            rig.Box(out double[] low, out double[] high);
            using (var pin = new FaceMesh(rig, new[] { 0, (low[1] + high[1]) / 2, high[2] }))
            using (var face = new Face(pin))
            {
                var place = new float[3];
                face.Evaluate(place);
                Expect(pin.VertexCount == 1 && place[2] > low[2] && place[2] <= high[2], "a point of the surface");
            }
            Refuses<SweepfaceException>(() => new FaceMesh(rig, 65), "64");
            Refuses<ArgumentOutOfRangeException>(() => new FaceMesh(rig, -1), "lod");
            Refuses<ArgumentException>(() => new FaceMesh(rig, new double[4]), "three numbers each");
            fine.Origins(out int[] sources, out float[] shares);
            Expect(sources.Max() < 8216 && Math.Abs(shares.Take(4).Sum() - 1) < 1e-6, "origins");
        }
        Refuses<SweepfaceException>(() => new FaceRig(new byte[] { 1, 2, 3 }, "broken.sweep"), "broken.sweep");
        Refuses<SweepfaceException>(() => new FaceRig(bytes, "face.sweep", 1000), "memory");
        Refuses<ArgumentNullException>(() => new FaceRig(null), "bytes");
        Refuses<ArgumentNullException>(() => new FaceMesh((FaceRig)null), "rig");
        Refuses<ArgumentNullException>(() => new Face(null), "mesh");
        Refuses<ArgumentNullException>(() => new FaceMotion(null), "numbers");
    }

    static void MovesAndTurns(byte[] bytes)
    {
        var weights = new double[2];
        using (var motion = new FaceMotion(weights))
        {
            Drive spring = Drive.Of(DriveKind.Spring);
            spring.Damping = 0.3;
            motion.MoveTo(new double[] { 1, 0 }, spring);
            using (FaceMotion ahead = motion.Copy())
            {
                double most = 0;
                for (int frame = 0; frame < 60; ++frame)
                {
                    ahead.Advance(1 / 60.0);
                    ahead.Positions(weights);
                    most = Math.Max(most, weights[0]);
                }
                Expect(most > 1.2 && most < 1.5, "a spring overshoots");
            }
            motion.Positions(weights);
            Expect(weights[0] == 0 && motion.Moves(), "a copy moves alone");
            motion.Push(1, 3, 1);
            motion.Velocities(weights);
            Expect(weights[1] == 3, "an impulse");
            Refuses<SweepfaceException>(() => motion.MoveTo(2, 1, spring), "2");
            motion.MoveTo(0, 1, Drive.Of(DriveKind.Cut));
            motion.MoveTo(1, 2);  // by a spring
            motion.Advance(10);
            motion.Positions(weights);
            Expect(weights[0] == 1 && Math.Abs(weights[1] - 2) < 1e-3, "a cut, and a spring without a drive");
        }
        using (var rig = new FaceRig(bytes))
        {
            rig.Follow(Following.Combine);
            Expect(rig.TurnEyes() == 2 && rig.Tolerance >= 0, "eyes");
            using (var mesh = new FaceMesh(rig))
            using (var face = new Face(mesh))
            {
                var straight = new float[3 * mesh.VertexCount];
                var left = new float[3 * mesh.VertexCount];
                face.Evaluate(straight);
                face.Look(new HeadPose { LeftEye = new Angles { Yaw = 0.3 }, RightEye = new Angles { Yaw = 0.3 } });
                face.Evaluate(left);
                Expect(Farthest(straight, left, left.Length) > 0.1, "eyes turn");
                face.Look(null);
                face.Evaluate(left);
                Expect(Farthest(straight, left, left.Length) == 0, "and look straight again");
                var quaternion = new double[4];
                new Angles { Yaw = Math.PI / 2 }.Quaternion(quaternion);
                Expect(Math.Abs(quaternion[1] - Math.Sqrt(0.5)) < 1e-12, "a quaternion about y");
            }
        }
    }

    static void MovesInRegions(byte[] bytes)
    {
        using (var rig = new FaceRig(bytes))
        {
            Expect(rig.RegionNames.Single() == null, "one region at first");
            rig.Box(out double[] low, out double[] high);
            var brush = new Brush { Points = new[] { 0, (3 * low[1] + high[1]) / 4, high[2] }, Whole = 5, Fade = 3, ThroughSpace = true };
            double[] chin = rig.Paint(brush);
            Expect(chin.Length == rig.NodeCount && chin.Max() == 1 && chin.Min() == 0, "what a brush paints");
            Expect(rig.Paint(brush, 3).Length == 3 * rig.NodeCount, "bands");
            Expect(rig.Paint(new Brush { Parts = new[] { "skin" } }).Average() > 0.3, "a material");
            double[] node = rig.Paint(new Brush { Nodes = new[] { "7" }, NodeShares = new[] { 0.25 } });
            Expect(node[7] == 0.25 && node.Sum() == 0.25, "a node");
            Refuses<SweepfaceException>(() => rig.Paint(new Brush { Parts = new[] { "hair" } }), "hair");
            Refuses<ArgumentException>(() => rig.Paint(new Brush { Points = new double[4] }), "three numbers each");
            Refuses<ArgumentException>(() => rig.Paint(new Brush { Nodes = new[] { "7" } }), "needs a share");
            Refuses<ArgumentException>(() => rig.Divide(new[] { "chin" }, new double[3]), "shares for each region");
            rig.Divide(new[] { "chin" }, chin);
            Expect(rig.RegionNames.SequenceEqual(new[] { "rest", "chin" }), "names of regions");
            int jaw = rig.Find("jawOpen"), count = rig.TargetNames.Length;
            using (var mesh = new FaceMesh(rig))
            using (var face = new Face(mesh))
            using (var motion = new FaceMotion(new double[count], new[] {
                       new Matter { Mass = 1, Stiffness = 1 }, new Matter { Mass = 4, Stiffness = 1, Delay = 0.1 } }))
            {
                Expect(mesh.RegionCount == 2, "regions of a mesh");
                motion.MoveTo(jaw, 1);
                motion.Advance(0.2);
                var weights = new double[2 * count];
                motion.Positions(weights);
                Expect(weights[jaw] > 0.2 && weights[count + jaw] < weights[jaw], "what is heavy lags behind");
                motion.PutIn(0, jaw, 0);
                motion.MoveIn(1, jaw, 0.5, Drive.Of(DriveKind.Cut));
                motion.Advance(1);
                motion.Positions(weights);
                Expect(weights[jaw] == 0 && weights[count + jaw] == 0.5, "goals of one region");
                face.SetWeights(1, weights.Skip(count).ToArray());
                var one = new float[3 * mesh.VertexCount];
                var both = new float[3 * mesh.VertexCount];
                face.Evaluate(one);
                face.SetWeights(weights.Skip(count).ToArray());
                face.Evaluate(both);
                Expect(Farthest(one, both, one.Length) > 0.1, "weights of one region");
                Refuses<SweepfaceException>(() => face.SetWeights(2, weights), "2");
            }
            rig.Divide(new string[0], new double[0]);
            Expect(rig.RegionNames.Length == 1, "one region again");
        }
    }

#if SWEEPFACE_CLIPS
    static void PlaysClips(byte[] bytes, string take)
    {
        using (var rig = new FaceRig(bytes))
        using (var clip = new FaceClip(rig, File.ReadAllBytes(take), take))
        {
            var weights = new double[rig.TargetNames.Length];
            clip.Weights(clip.Seconds / 2, weights);
            Expect(Math.Abs(weights[rig.Find("jawOpen")] - 0.4) < 0.01 && Math.Abs(clip.Seconds - 0.5) < 1e-9, "weights of a clip");
            Expect(clip.Unmatched.Single() == "TongueOut" && clip.Undriven.Length == 41 && clip.Warnings.Length == 0, "names of a clip");
            using (var other = new FaceClip(rig, File.ReadAllBytes(take), take, names: "{\"TongueOut\": \"mouthSmileLeft\"}"))
                Expect(other.Unmatched.Length == 0, "a map of names");
            byte[] regions = System.Text.Encoding.UTF8.GetBytes(
                "{\"regions\": [{\"name\": \"skin\", \"parts\": [\"skin\"], \"mass\": 3, \"delay\": 0.1}]}");
            rig.Divide(regions, "skin.json");
            int skin = Array.IndexOf(rig.RegionNames, "skin");
            Expect(rig.MatterOf(skin).Mass == 3 && rig.MatterOf(1 - skin).Mass == 1, "matters of a text");
            using (var parted = new FaceClip(rig, File.ReadAllBytes(take), take))
            {
                var parts = new double[2 * weights.Length];
                parted.Weights(clip.Seconds / 2, parts);
                int jaw = rig.Find("jawOpen");
                Expect(parted.RegionCount == 2 && parts[skin * weights.Length + jaw] < parts[(1 - skin) * weights.Length + jaw],
                       "regions of a clip");
            }
            Refuses<SweepfaceException>(() => rig.Divide(new byte[] { 7 }, "skin.json"), "skin.json");
            Expect(clip.HasHead && !clip.HasEyes && Math.Abs(clip.Pose(0).Head.Yaw + 0.1) < 1e-9, "angles of a clip");
        }
    }
#endif

    static void PlaysInUnity(byte[] bytes)
    {
        var player = new SweepfacePlayer();
        player.OnDisable();  // though it was never enabled
        player.Update();
        int jaw;
        using (var rig = new FaceRig(bytes)) jaw = rig.Find("jawOpen");
        player.file = new UnityEngine.TextAsset { bytes = bytes };
        player.OnEnable();
        UnityEngine.Mesh shown = player.GetComponent<UnityEngine.MeshFilter>().sharedMesh;
        UnityEngine.Vector3[] before = shown.vertices;
        Expect(shown.subMeshes.Length > 3 && shown.subMeshes.Sum(part => part.Length) > 40000, "a submesh for each part");
        Expect(shown.uv.Length == before.Length && player.transform.localScale.x == -0.01f, "a mesh in Unity");
        player.weights[jaw] = 1;
        UnityEngine.Time.deltaTime = 0.5f;  // a single long frame arrives, too
        player.Update();
        double moved = before.Zip(shown.vertices, (a, b) => Math.Abs((double)a.y - b.y)).Max();
        Expect(moved > 1 && moved < 3, "it opens its jaw there");
        Expect(shown.vertices.All(v => shown.bounds.min.y <= v.y && v.y <= shown.bounds.max.y), "within its bounds");
        UnityEngine.Vector3[] open = shown.vertices;
        player.Update();
        Expect(shown.vertices == open, "nothing is drawn at rest");
        player.OnDisable();
        player.Update();
        Expect(shown.isDestroyed, "it frees its mesh");
        player.OnEnable();
        Expect(player.weights[jaw] == 1 &&
               player.GetComponent<UnityEngine.MeshFilter>().sharedMesh.vertices.Zip(open, (a, b) => Math.Abs(a.y - b.y)).Max() < 0.01,
               "it comes back where it was");
        player.OnDisable();
    }

    static int Main(string[] arguments)
    {
        byte[] bytes = File.ReadAllBytes(arguments[0]);
        PlaysExpressions(new FaceRig(bytes, arguments[0]), arguments[1]);
        ComesAtLevelsOfDetail(bytes);
        MovesAndTurns(bytes);
        MovesInRegions(bytes);
        PlaysInUnity(bytes);
#if SWEEPFACE_CLIPS
        PlaysClips(bytes, arguments[2]);
#endif
        Console.WriteLine(failures == 0 ? "all is well" : failures + " failed");
        return failures == 0 ? 0 : 1;
    }
}
