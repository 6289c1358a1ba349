! RAPID Overview, Axis configuration: cf6 counts the quarter turns of axis 6, whole turns included.
MODULE turns_of_axis_6
  CONST robtarget near:=[[700,100,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget wound:=[[700,100,600],[0,0,1,0],[0,0,-4,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    VAR jointtarget before;
    VAR jointtarget after;
    MoveJ near,v1000,fine,tool0;
    before:=CJointT();
    MoveJ wound,v1000,fine,tool0;
    after:=CJointT();
    TPWrite "turned "\Num:=Round(after.robax.rax_6-before.robax.rax_6);     ! -> turned -360
    TPWrite "same place "\Pos:=CPos(\Tool:=tool0);          ! -> same place [700,100,600]
  ENDPROC
ENDMODULE
