MODULE example
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p10,v500,fine,tool0;
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p20:=[[600,150,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    from_where_it_is;
    to_start;
    MoveL p10,v500,fine,tool0;
  ENDPROC
  PROC to_start()
    MoveJ p20,v500,fine,tool0;
  ENDPROC
  PROC from_where_it_is()
    MoveL Offs(CRobT(),0,0,50),v100,fine,tool0;
  ENDPROC
  PROC only_a_line()
    MoveL p20,v500,fine,tool0;
  ENDPROC
ENDMODULE
