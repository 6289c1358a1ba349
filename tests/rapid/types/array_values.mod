! RAPID Kernel, Assignment: arrays are copied whole.
MODULE array_values
  VAR num a{3}:=[1,2,3];
  VAR num b{3};
  VAR pos points{2}:=[[1,1,1],[2,2,2]];
  VAR pos one;

  PROC main()
    b:=a;
    a{1}:=100;
    TPWrite ValToStr(b);            ! -> [1,2,3]
    a:=[4,a{1},6];
    TPWrite ValToStr(a);            ! -> [4,100,6]
    one:=points{2};
    points{2}.x:=9;
    TPWrite ValToStr(one);          ! -> [2,2,2]
    TPWrite ValToStr(points);       ! -> [[1,1,1],[9,2,2]]
  ENDPROC
ENDMODULE
