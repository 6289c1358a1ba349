! RAPID Instructions, ConfL: a configuration that no way could end in is told as such.
MODULE line_to_a_stale_target
  CONST robtarget a:=[[700,200,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    MoveJ a,v500,fine,tool0;
    MoveL Offs(a,0,-400,0),v500,fine,tool0;      ! stops: `Offs(a,0,-400,0)` cannot be reached in its stored configuration [0,0,0,0]; [-1,0,-1,0] reaches it
  ENDPROC
ENDMODULE
