// As much of Unity's scripting interface as the example of docs/csharp.md uses, so that it is compiled and run here.
using System;
using System.Linq;

namespace UnityEngine
{
    public struct Vector2
    {
        public float x, y;
        public Vector2(float x, float y) { this.x = x; this.y = y; }
    }

    public struct Vector3
    {
        public float x, y, z;
        public Vector3(float x, float y, float z) { this.x = x; this.y = y; this.z = z; }
    }

    public struct Bounds
    {
        public Vector3 min, max;
        public void SetMinMax(Vector3 low, Vector3 high) { min = low; max = high; }
    }

    public sealed class TextAsset
    {
        public byte[] bytes;
        public string name = "face";
    }

    public sealed class Transform
    {
        public Vector3 localScale = new Vector3(0.01f, 0.01f, 0.01f);
    }

    public sealed class Mesh
    {
        Vector3[] places, directions;
        public Vector3[] vertices { get => places; set => places = value.ToArray(); }
        public Vector3[] normals { get => directions; set => directions = value.ToArray(); }
        public Vector2[] uv;
        public int[][] subMeshes;
        public Bounds bounds;
        public bool isDestroyed;
        public Rendering.IndexFormat indexFormat;
        public int subMeshCount { set => subMeshes = new int[value][]; }
        public void SetTriangles(int[] triangles, int start, int length, int submesh, bool calculateBounds) =>
            subMeshes[submesh] = triangles.Skip(start).Take(length).ToArray();
        public void MarkDynamic() { }
    }

    public sealed class MeshFilter
    {
        public Mesh sharedMesh;
    }

    public sealed class MeshRenderer { }

    public class MonoBehaviour
    {
        public readonly Transform transform = new Transform();
        readonly MeshFilter filter = new MeshFilter();
        public T GetComponent<T>() where T : class => filter as T;
        public static void Destroy(Mesh mesh) { mesh.isDestroyed = true; }
    }

    [AttributeUsage(AttributeTargets.Class)]
    public sealed class RequireComponent : Attribute
    {
        public RequireComponent(Type first, Type second) { }
    }

    public static class Time
    {
        public static float deltaTime = 1 / 60f;
    }
}

namespace UnityEngine.Rendering
{
    public enum IndexFormat { UInt16, UInt32 }
}
