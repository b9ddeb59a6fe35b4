// As much of Unity's scripting interface as the example of docs/csharp.md uses, so that it is compiled and run here.
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

    public sealed class TextAsset
    {
        public byte[] bytes;
    }

    public sealed class Transform
    {
        public Vector3 localScale;
    }

    public sealed class Mesh
    {
        public Vector3[] vertices, normals;
        public Vector2[] uv;
        public int[] triangles;
        public Rendering.IndexFormat indexFormat;
        public bool isDynamic;
        public void MarkDynamic() { isDynamic = true; }
        public void RecalculateBounds() { }
    }

    public sealed class MeshFilter
    {
        public Mesh sharedMesh;
    }

    public class MonoBehaviour
    {
        public readonly Transform transform = new Transform();
        public readonly MeshFilter filter = new MeshFilter();
        public T GetComponent<T>() where T : class => filter as T;
    }

    [System.AttributeUsage(System.AttributeTargets.Class)]
    public sealed class RequireComponent : System.Attribute
    {
        public RequireComponent(System.Type first, System.Type second) { }
    }

    public sealed class MeshRenderer { }

    public static class Time
    {
        public static float deltaTime = 1 / 60f;
    }
}

namespace UnityEngine.Rendering
{
    public enum IndexFormat { UInt16, UInt32 }
}
